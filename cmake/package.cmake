# `make package`: a Debian package for each component of the installation.
gough_revision(GOUGH_PACKAGE_VERSION ${PROJECT_SOURCE_DIR} ${PROJECT_VERSION})
set(GOUGH_SONAME ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gough)
set(CPACK_PACKAGE_CONTACT "gough developers <gough@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# each package has a summary of its own, the first line of its description; CPack would put that of the project before it
file(WRITE ${PROJECT_BINARY_DIR}/generated/package_config.cmake "set(CPACK_PACKAGE_DESCRIPTION_SUMMARY \"\")\n")
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/generated/package_config.cmake)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_VERSION ${GOUGH_PACKAGE_VERSION})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package_finish.cmake)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL command library development documentation)

# gough_package(COMPONENT NAME SUMMARY TEXT): a package with copyright and changelog of its own, as Debian wants them
set(GOUGH_PACKAGE_CHANGES ${PROJECT_BINARY_DIR}/generated/changelog)
gough_git(date ${PROJECT_SOURCE_DIR} log -1 --format=%cD)
if(date STREQUAL "")
    string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
file(WRITE ${GOUGH_PACKAGE_CHANGES} "gough (${GOUGH_PACKAGE_VERSION}) unstable; urgency=medium

  * Built from the sources; CHANGELOG.md in gough-doc lists all changes.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
execute_process(COMMAND gzip -9nc ${GOUGH_PACKAGE_CHANGES} OUTPUT_FILE ${GOUGH_PACKAGE_CHANGES}.gz COMMAND_ERROR_IS_FATAL ANY)
macro(gough_package component name summary text)
    string(TOUPPER ${component} key)
    set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
    set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}\n${text}")
    set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}")
    if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
        install(FILES ${GOUGH_PACKAGE_CHANGES}.gz DESTINATION share/doc/${name} COMPONENT ${component})
        if(NOT ${component} STREQUAL "command")
            install(FILES LICENSE DESTINATION share/doc/${name} RENAME copyright COMPONENT ${component})
        endif()
    endif()
endmacro()

gough_package(command gough "dynamics and control of Stewart-Gough platforms"
"Which leg forces a hexapod's motion needs, what motion given forces produce,
why open-loop forces cannot hold it and which feedback does. This package has
the command.")
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS gough-doc)

gough_package(library libgough${GOUGH_SONAME} "dynamics and control of Stewart-Gough platforms, libraries"
"The equations of motion of hexapods, analysis of their stability, and their
study files and results. This package has the shared libraries.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
# new libraries reach the loader's cache
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)

gough_package(development libgough-dev "dynamics and control of Stewart-Gough platforms, headers"
"The headers of libgough, its archives, and files for pkg-config and CMake.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libgough${GOUGH_SONAME} (= ${GOUGH_PACKAGE_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
    "libfyaml-dev, libhdf5-dev, liblapacke-dev, libnlopt-dev")

gough_package(documentation gough-doc "dynamics and control of Stewart-Gough platforms, documentation"
"The guides to gough, the theory behind it, and examples of studies.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)

if(GOUGH_PYTHON AND GOUGH_PYTHON_FOUND)
    list(APPEND CPACK_COMPONENTS_ALL python)
    gough_package(python python3-gough "dynamics and control of Stewart-Gough platforms, Python 3"
"The verbs of gough as functions that return arrays of numpy, and machines in
many poses at once.")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "gough (= ${GOUGH_PACKAGE_VERSION}), python3 (>= 3.11), python3-numpy")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-pandas, python3-xarray")
endif()
if(MPI_C_FOUND)
    list(APPEND CPACK_COMPONENTS_ALL mpi)
    gough_package(mpi gough-mpi "dynamics and control of Stewart-Gough platforms, sweeps by MPI"
"Runs sweeps of gough on many machines, with the processes of Open MPI.")
    set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS openmpi-bin)
endif()
include(CPack)
