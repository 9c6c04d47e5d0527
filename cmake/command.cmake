# The command. The examples travel inside it, as bytes in generated C.
file(GLOB GOUGH_CLI_SOURCES CONFIGURE_DEPENDS src/cli/*.c)
file(GLOB GOUGH_EXAMPLES CONFIGURE_DEPENDS examples/*.yaml examples/*.awk)
set(GOUGH_EMBEDDED ${PROJECT_BINARY_DIR}/generated/examples.c)
add_custom_command(OUTPUT ${GOUGH_EMBEDDED}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${GOUGH_EXAMPLES}" -DOUTPUT=${GOUGH_EMBEDDED}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${GOUGH_EXAMPLES} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    COMMENT "Embedding the examples" VERBATIM)
add_executable(gough_command ${GOUGH_CLI_SOURCES} ${GOUGH_EMBEDDED})
set_target_properties(gough_command PROPERTIES OUTPUT_NAME gough)
target_link_libraries(gough_command PRIVATE gough_files PkgConfig::JANSSON)

# for the tests of the command
if(GOUGH_TESTS_SANITIZED)
    add_executable(gough_command_sanitized ${GOUGH_CLI_SOURCES} ${GOUGH_EMBEDDED})
    set_target_properties(gough_command_sanitized PROPERTIES RUNTIME_OUTPUT_DIRECTORY sanitized OUTPUT_NAME gough)
    target_link_libraries(gough_command_sanitized PRIVATE gough_files_sanitized gough_sanitizers PkgConfig::JANSSON)
endif()
