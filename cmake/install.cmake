# What `make install` puts where. The man page and the completions are those that gough_manual has written (cmake/command.cmake).
include(CMakePackageConfigHelpers)

install(TARGETS gough_command RUNTIME)
install(FILES ${PROJECT_BINARY_DIR}/libgough.a DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS gough_shared gough_analyse_shared gough_files_shared EXPORT gough-targets LIBRARY)
install(DIRECTORY include/gough DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" PATTERN "*.def")
install(FILES ${PROJECT_BINARY_DIR}/include/gough/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gough)

# find_package(gough): targets gough::gough (core), gough::analyse and gough::files; gough::static is the core as libgough.a
set(GOUGH_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/gough)
install(EXPORT gough-targets NAMESPACE gough:: DESTINATION ${GOUGH_CMAKE_FOLDER})
list(JOIN GOUGH_MATH "$<SEMICOLON>" GOUGH_STATIC_NEEDS)
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/gough-config.cmake CONTENT
    "include(CMakeFindDependencyMacro)
find_dependency(Threads)
include(\"\${CMAKE_CURRENT_LIST_DIR}/gough-targets.cmake\")
get_filename_component(gough_libraries \"\${CMAKE_CURRENT_LIST_DIR}/../..\" ABSOLUTE)
add_library(gough::static STATIC IMPORTED)
set_target_properties(gough::static PROPERTIES IMPORTED_LOCATION \"\${gough_libraries}/libgough.a\")
get_target_property(gough_includes gough::gough INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(gough::static INTERFACE \${gough_includes})
target_link_libraries(gough::static INTERFACE ${GOUGH_STATIC_NEEDS} Threads::Threads)
")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gough-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gough-config.cmake ${PROJECT_BINARY_DIR}/gough-config-version.cmake
    DESTINATION ${GOUGH_CMAKE_FOLDER})

# pkg-config: gough (core), gough-analyse and gough-files
list(TRANSFORM GOUGH_MATH PREPEND "-l" OUTPUT_VARIABLE GOUGH_MATH_LINK)
list(JOIN GOUGH_MATH_LINK " " GOUGH_MATH_LINK)
file(RELATIVE_PATH GOUGH_PC_UP /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" GOUGH_PC_UP "${GOUGH_PC_UP}")
foreach(name gough gough-analyse gough-files)
    configure_file(cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

# as Debian wants it: manual page and changelog compressed, without a time stamp
set(GOUGH_MAN ${PROJECT_BINARY_DIR}/docs/man/gough.1)
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/gough.1.gz
        COMMAND gzip -9nc ${GOUGH_MAN} > ${PROJECT_BINARY_DIR}/gough.1.gz DEPENDS ${GOUGH_MAN} VERBATIM)
    add_custom_target(gough_man_compressed ALL DEPENDS ${PROJECT_BINARY_DIR}/gough.1.gz)
    add_dependencies(gough_man_compressed gough_pages)
    set(GOUGH_MAN ${PROJECT_BINARY_DIR}/gough.1.gz)
    if(EXISTS ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS CHANGELOG.md)
        execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md
            OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
    endif()
    install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
else()
    install(FILES CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
endif()
install(FILES ${GOUGH_MAN} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${PROJECT_BINARY_DIR}/completions/gough.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME gough)
# zsh looks for a package's completions elsewhere than for the administrator's
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    install(FILES ${PROJECT_BINARY_DIR}/completions/_gough DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
else()
    install(FILES ${PROJECT_BINARY_DIR}/completions/_gough DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
endif()
install(FILES ${PROJECT_BINARY_DIR}/completions/gough.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN "man" EXCLUDE
    PATTERN "images" EXCLUDE)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
