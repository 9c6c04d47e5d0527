# Flags of every object. Same bits from every compiler and level: no contraction, no reassociation.
add_library(gough_flags INTERFACE)
target_compile_options(gough_flags INTERFACE
    -ffp-contract=off -fno-math-errno -fvisibility=hidden
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla
    -Wno-psabi) # lanes are inlined: how a call would pass them does not matter
target_include_directories(gough_flags INTERFACE
    ${PROJECT_SOURCE_DIR}/include ${PROJECT_BINARY_DIR}/include ${PROJECT_SOURCE_DIR}/src)
if(GOUGH_WERROR)
    target_compile_options(gough_flags INTERFACE -Werror)
endif()

# The sanitizers, for one target or for all.
add_library(gough_sanitizers INTERFACE)
target_compile_options(gough_sanitizers INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g -O1 -UNDEBUG
    "$<$<C_COMPILER_ID:GNU>:-Wno-format-truncation;-Wno-maybe-uninitialized>") # instrumented code misleads GCC
target_link_options(gough_sanitizers INTERFACE -fsanitize=address,undefined)
if(GOUGH_SANITIZE)
    target_link_libraries(gough_flags INTERFACE gough_sanitizers)
endif()
if(GOUGH_FUZZ)
    target_compile_options(gough_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
