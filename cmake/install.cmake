# What `make install` puts where, in components, each of which is a Debian package (cmake/package.cmake). The man page and the
# completions are those that gough_manual has written (cmake/command.cmake).
include(CMakePackageConfigHelpers)

install(TARGETS gough_command RUNTIME COMPONENT command)
if(MPI_C_FOUND)
    install(TARGETS gough_mpi RUNTIME COMPONENT mpi)
endif()
install(FILES ${GOUGH_ARCHIVES} DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY include/gough DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.h" PATTERN "*.def")
install(FILES ${PROJECT_BINARY_DIR}/include/gough/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gough COMPONENT development)

# find_package(gough): gough::gough (core), gough::analyse, gough::files, and the same as archives: gough::static, gough::analyse-static,
# gough::files-static. Without shared libraries the first three are the archives.
set(GOUGH_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/gough)
if(BUILD_SHARED_LIBS)
    install(TARGETS gough_shared gough_analyse_shared gough_files_shared EXPORT gough-targets
        LIBRARY COMPONENT library NAMELINK_COMPONENT development)
    install(EXPORT gough-targets NAMESPACE gough:: DESTINATION ${GOUGH_CMAKE_FOLDER} COMPONENT development)
endif()
file(RELATIVE_PATH GOUGH_PREFIX_UP /${CMAKE_INSTALL_LIBDIR} /)
string(REGEX REPLACE "/$" "" GOUGH_PREFIX_UP "${GOUGH_PREFIX_UP}")
set(GOUGH_ANALYSE_NEEDS ${NLOPT_LDFLAGS} ${LAPACKE_LDFLAGS})
set(GOUGH_FILES_NEEDS ${LIBFYAML_LDFLAGS} ${HDF5_LDFLAGS})
list(JOIN GOUGH_ANALYSE_NEEDS " " GOUGH_ANALYSE_WORDS)
list(JOIN GOUGH_FILES_NEEDS " " GOUGH_FILES_WORDS)
list(JOIN GOUGH_MATH " " GOUGH_MATH_WORDS)
configure_file(cmake/gough-config.cmake.in ${PROJECT_BINARY_DIR}/gough-config.cmake @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gough-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gough-config.cmake ${PROJECT_BINARY_DIR}/gough-config-version.cmake
    DESTINATION ${GOUGH_CMAKE_FOLDER} COMPONENT development)

# pkg-config: gough (core), gough-analyse and gough-files; what archives need besides is in Libs.private, or in Libs where there are
# archives only
list(TRANSFORM GOUGH_MATH PREPEND "-l" OUTPUT_VARIABLE GOUGH_NEEDS)
list(APPEND GOUGH_NEEDS -pthread)
foreach(needs GOUGH_NEEDS GOUGH_ANALYSE_NEEDS GOUGH_FILES_NEEDS)
    list(JOIN ${needs} " " words)
    set(${needs}_ALWAYS)
    set(${needs}_PRIVATE)
    if(BUILD_SHARED_LIBS)
        set(${needs}_PRIVATE "\nLibs.private: ${words}")
    else()
        set(${needs}_ALWAYS " ${words}")
    endif()
endforeach()
file(RELATIVE_PATH GOUGH_PC_UP /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" GOUGH_PC_UP "${GOUGH_PC_UP}")
foreach(name gough gough-analyse gough-files)
    configure_file(cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()

# The package for Python, without a command of its own: beside Debian's packages only, for `make python` makes a wheel for others.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr" AND GOUGH_PYTHON AND GOUGH_PYTHON_FOUND)
    install(TARGETS gough_python_module LIBRARY DESTINATION lib/python3/dist-packages/gough COMPONENT python)
    install(FILES ${GOUGH_PYTHON_FILES} DESTINATION lib/python3/dist-packages/gough COMPONENT python)
endif()

set(GOUGH_MAN ${PROJECT_BINARY_DIR}/docs/man/gough.1)
set(GOUGH_MPI_MAN ${PROJECT_SOURCE_DIR}/docs/man/gough-mpi.1)
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    # as Debian wants it: manual pages compressed, without a time stamp
    foreach(page GOUGH_MAN GOUGH_MPI_MAN)
        get_filename_component(name ${${page}} NAME)
        add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/${name}.gz
            COMMAND gzip -9nc ${${page}} > ${PROJECT_BINARY_DIR}/${name}.gz DEPENDS ${${page}} VERBATIM)
        set(${page} ${PROJECT_BINARY_DIR}/${name}.gz)
    endforeach()
    add_custom_target(gough_man_compressed ALL DEPENDS ${GOUGH_MAN} ${GOUGH_MPI_MAN})
    add_dependencies(gough_man_compressed gough_pages)
endif()
install(FILES ${GOUGH_MAN} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
if(MPI_C_FOUND)
    install(FILES ${GOUGH_MPI_MAN} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT mpi)
endif()
install(FILES ${PROJECT_BINARY_DIR}/completions/gough.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME gough
    COMPONENT command)
# zsh looks for a package's completions elsewhere than for the administrator's
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(GOUGH_ZSH vendor-completions)
else()
    set(GOUGH_ZSH site-functions)
endif()
install(FILES ${PROJECT_BINARY_DIR}/completions/_gough DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${GOUGH_ZSH} COMPONENT command)
install(FILES ${PROJECT_BINARY_DIR}/completions/gough.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT command)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT command)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT documentation)

# The texts, whose links are made to fit where they lie then
install(DIRECTORY docs/images DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documentation)
file(RELATIVE_PATH GOUGH_HEADERS_FROM_DOCS /${CMAKE_INSTALL_DOCDIR} /${CMAKE_INSTALL_INCLUDEDIR})
install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")
set(FOLDER \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")
set(HEADERS \"${GOUGH_HEADERS_FROM_DOCS}\")
include(\"${PROJECT_SOURCE_DIR}/cmake/installed_docs.cmake\")" COMPONENT documentation)
