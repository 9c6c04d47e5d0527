# The page that `gough report` fills: its core, the library's texts as WebAssembly (page_core: web/core.wasm in the build
# folder). Included only with GOUGH_PAGE.
find_program(GOUGH_PAGE_CLANG NAMES clang clang-20 clang-19 clang-18 clang-17 clang-16 clang-15 clang-14)
find_program(GOUGH_PAGE_LINKER NAMES wasm-ld wasm-ld-20 wasm-ld-19 wasm-ld-18 wasm-ld-17 wasm-ld-16 wasm-ld-15 wasm-ld-14)
set(GOUGH_PAGE_FOLDER ${PROJECT_BINARY_DIR}/web)
file(MAKE_DIRECTORY ${GOUGH_PAGE_FOLDER})

# The texts in double precision; web/core/live.c takes the place of src/run/run_double.c,
# and without wide registers nothing is made ready side by side.
file(GLOB GOUGH_PAGE_CORE_SOURCES CONFIGURE_DEPENDS web/core/*.c
    src/base/*.c src/kernel/*.c src/drive/*.c src/program/*.c src/plant/*.c src/control/*.c src/model/*.c src/integrate/*.c src/run/*.c
    src/pose/*.c src/workspace/*.c)
list(FILTER GOUGH_PAGE_CORE_SOURCES EXCLUDE REGEX "(_quad|_complex|crew|version|(run_double|prefetch|_lanes_[48]|pose_single)[^/]*)\\.c$")
# long double is quadruple precision there, for the ends of poses that need it
list(APPEND GOUGH_PAGE_CORE_SOURCES ${PROJECT_SOURCE_DIR}/src/pose/polish_quad.c)
file(GLOB GOUGH_PAGE_CORE_HEADERS CONFIGURE_DEPENDS web/core/*.h include/gough/*.h include/gough/*.def
    src/model/*.def src/base/*.h src/kernel/*.h src/drive/*.h src/program/*.h src/plant/*.h src/control/*.h src/model/*.h src/integrate/*.h src/system/*.h src/run/*.h src/pose/*.h src/workspace/*.h)

# -Oz is a tenth smaller than -Os, and about as fast here as -O3. Numbers beyond the integers saturate rather than trap; browsers that
# know this have instructions that copy memory and extend signs, too. The stack of a module is 64 KiB unless told; runs keep their
# steps on it. No entry: the page calls what web/core/live.h names.
set(GOUGH_PAGE_CORE_FLAGS --target=wasm32-wasi -std=c17 -Oz -DNDEBUG -ffp-contract=off -fno-math-errno -fvisibility=hidden
    -mnontrapping-fptoint -mbulk-memory -msign-ext
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla
    -nostartfiles -Wl,--no-entry -Wl,-z,stack-size=1048576 -Wl,--strip-all)
if(GOUGH_WERROR)
    list(APPEND GOUGH_PAGE_CORE_FLAGS -Werror)
endif()

# Whether compiler, linker, C library and the compiler's own library are all there: a module that needs each.
file(WRITE ${GOUGH_PAGE_FOLDER}/probe.c "#include <math.h>
#include <stdio.h>
__attribute__((export_name(\"probe\"))) int probe(double x);
int probe(double x) {
    char text[40];
    return snprintf(text, sizeof text, \"%g\", (double)((long double)x * x) + sin(x));
}
")
set(failed 1)
set(said "clang or wasm-ld was not found")
if(GOUGH_PAGE_CLANG AND GOUGH_PAGE_LINKER)
    execute_process(
        COMMAND ${GOUGH_PAGE_CLANG} ${GOUGH_PAGE_CORE_FLAGS} -o ${GOUGH_PAGE_FOLDER}/probe.wasm ${GOUGH_PAGE_FOLDER}/probe.c
        RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
endif()
if(NOT failed EQUAL 0)
    message(FATAL_ERROR "The page of `gough report` has the library compiled to WebAssembly, which needs the Debian packages "
        "clang, lld, wasi-libc and libclang-rt-14-dev-wasm32 (scripts/install-packages.sh webassembly installs them). "
        "Without them, configure with -DGOUGH_PAGE=OFF.\n${said}")
endif()

set(GOUGH_PAGE_CORE ${GOUGH_PAGE_FOLDER}/core.wasm)
add_custom_command(OUTPUT ${GOUGH_PAGE_CORE}
    COMMAND ${GOUGH_PAGE_CLANG} ${GOUGH_PAGE_CORE_FLAGS} -I${PROJECT_SOURCE_DIR}/include -I${PROJECT_BINARY_DIR}/include
            -I${PROJECT_SOURCE_DIR}/src -I${PROJECT_SOURCE_DIR}/web/core -o ${GOUGH_PAGE_CORE} ${GOUGH_PAGE_CORE_SOURCES}
    DEPENDS ${GOUGH_PAGE_CORE_SOURCES} ${GOUGH_PAGE_CORE_HEADERS}
    COMMENT "Compiling the core to WebAssembly" VERBATIM)
add_custom_target(page_core DEPENDS ${GOUGH_PAGE_CORE})
