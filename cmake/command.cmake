# The command. The examples travel inside it, as bytes in generated C.
file(GLOB_RECURSE GOUGH_CLI_SOURCES CONFIGURE_DEPENDS src/cli/*.c)
file(GLOB GOUGH_MANUAL_SOURCES CONFIGURE_DEPENDS src/cli/manual/*.c)
file(GLOB GOUGH_MPI_SOURCES CONFIGURE_DEPENDS src/cli/mpi/*.c)
# who runs a sweep: the command's own threads or the processes of MPI
set(GOUGH_OWN_CREW ${PROJECT_SOURCE_DIR}/src/cli/sweep/sweep_crew_threads.c)
list(REMOVE_ITEM GOUGH_CLI_SOURCES ${GOUGH_MANUAL_SOURCES} ${GOUGH_MPI_SOURCES} ${GOUGH_OWN_CREW} ${PROJECT_SOURCE_DIR}/src/cli/main.c)
file(GLOB GOUGH_EXAMPLES CONFIGURE_DEPENDS examples/*.yaml examples/*.awk)
set(GOUGH_EMBEDDED ${PROJECT_BINARY_DIR}/generated/examples.c)
add_custom_command(OUTPUT ${GOUGH_EMBEDDED}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${GOUGH_EXAMPLES}" -DOUTPUT=${GOUGH_EMBEDDED}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${GOUGH_EXAMPLES} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    COMMENT "Embedding the examples" VERBATIM)

# The page travels inside it too, as the assembler takes it in; without the page its length is 0.
set(GOUGH_PAGE_OBJECT ${PROJECT_BINARY_DIR}/generated/page_template.c)
if(TARGET page_template)
    file(CONFIGURE OUTPUT ${GOUGH_PAGE_OBJECT} @ONLY CONTENT [[
#include "cli/report/page_study.h"

__asm__(".section .rodata\n"
        ".globl page_template_bytes\n"
        "page_template_bytes:\n"
        ".incbin \"@GOUGH_PAGE_TEMPLATE@\"\n"
        ".globl page_template_end\n"
        "page_template_end:\n"
        ".byte 0\n"
        ".text\n");
extern const char page_template_bytes[], page_template_end[];

gough_page_template page_template(void) {
    return (gough_page_template){page_template_bytes, (size_t)(page_template_end - page_template_bytes)};
}
]])
    set_source_files_properties(${GOUGH_PAGE_OBJECT} PROPERTIES OBJECT_DEPENDS ${GOUGH_PAGE_TEMPLATE})
else()
    file(CONFIGURE OUTPUT ${GOUGH_PAGE_OBJECT} @ONLY CONTENT [[
#include "cli/report/page_study.h"

gough_page_template page_template(void) { return (gough_page_template){"", 0}; }
]])
endif()

# What `gough --version` prints: asked for in each build, for a commit changes no source.
set(GOUGH_REVISION_SOURCE ${PROJECT_BINARY_DIR}/generated/command_version.c)
add_custom_target(gough_revision
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -DOUTPUT=${GOUGH_REVISION_SOURCE}
            -P ${PROJECT_SOURCE_DIR}/cmake/revision.cmake
    BYPRODUCTS ${GOUGH_REVISION_SOURCE} VERBATIM)

add_library(gough_verbs OBJECT ${GOUGH_CLI_SOURCES} ${GOUGH_EMBEDDED} ${GOUGH_PAGE_OBJECT} ${GOUGH_REVISION_SOURCE})
add_dependencies(gough_verbs gough_revision)
if(TARGET page_template)
    add_dependencies(gough_verbs page_template)
endif()
target_link_libraries(gough_verbs PUBLIC gough_files PkgConfig::JANSSON PkgConfig::ZLIB)
add_executable(gough_command src/cli/main.c ${GOUGH_OWN_CREW})
set_target_properties(gough_command PROPERTIES OUTPUT_NAME gough)
target_link_libraries(gough_command PRIVATE gough_verbs)

# gough-mpi, where there is an MPI: the same command, whose sweeps run on the processes that mpirun starts.
if(GOUGH_MPI AND NOT GOUGH_SANITIZE AND NOT GOUGH_FUZZ)
    find_package(MPI QUIET COMPONENTS C)
endif()
if(MPI_C_FOUND)
    add_executable(gough_mpi src/cli/main.c ${GOUGH_MPI_SOURCES})
    set_target_properties(gough_mpi PROPERTIES OUTPUT_NAME gough-mpi)
    target_link_libraries(gough_mpi PRIVATE gough_verbs MPI::MPI_C)
else()
    message(STATUS "No MPI (Debian packages libopenmpi-dev and openmpi-bin): building without gough-mpi")
    add_custom_target(gough_mpi) # has nothing to build
endif()

# The man page and the completions, from their templates and the tables of verbs and options.
add_executable(gough_manual ${GOUGH_MANUAL_SOURCES} ${GOUGH_OWN_CREW})
target_link_libraries(gough_manual PRIVATE gough_verbs)
set(GOUGH_MANUAL)
foreach(triple man|docs/man/gough.1 bash|completions/gough.bash zsh|completions/_gough fish|completions/gough.fish)
    string(REPLACE "|" ";" triple ${triple})
    list(GET triple 0 kind)
    list(GET triple 1 name)
    get_filename_component(folder ${PROJECT_BINARY_DIR}/${name} DIRECTORY)
    add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/${name}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
        COMMAND gough_manual ${kind} ${PROJECT_SOURCE_DIR}/${name}.in ${PROJECT_BINARY_DIR}/${name}
        DEPENDS gough_manual ${PROJECT_SOURCE_DIR}/${name}.in
        COMMENT "Writing ${name}" VERBATIM)
    list(APPEND GOUGH_MANUAL ${PROJECT_BINARY_DIR}/${name})
endforeach()
add_custom_target(gough_pages ALL DEPENDS ${GOUGH_MANUAL})

# for the tests of the command
if(GOUGH_TESTS_SANITIZED)
    add_executable(gough_command_sanitized src/cli/main.c ${GOUGH_OWN_CREW} ${GOUGH_CLI_SOURCES} ${GOUGH_EMBEDDED} ${GOUGH_PAGE_OBJECT}
        ${GOUGH_REVISION_SOURCE})
    add_dependencies(gough_command_sanitized gough_revision)
    if(TARGET page_template)
        add_dependencies(gough_command_sanitized page_template)
    endif()
    set_target_properties(gough_command_sanitized PROPERTIES RUNTIME_OUTPUT_DIRECTORY sanitized OUTPUT_NAME gough)
    target_link_libraries(gough_command_sanitized PRIVATE gough_files_sanitized gough_sanitizers PkgConfig::JANSSON PkgConfig::ZLIB)
endif()
