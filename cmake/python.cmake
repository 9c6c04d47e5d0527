# The package for Python, in python/: build/python/gough, importable as it is, and `gough_wheel`, a wheel in the build folder. It is
# made for Debian's python3, which has Debian's numpy, or for GOUGH_PYTHON_PROGRAM; the part in C uses the stable interface of
# Python 3.11, so that later versions load it, too. Without Python's headers or numpy the build leaves the package out.
find_program(GOUGH_PYTHON_PROGRAM python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "Python for which the package is built")
set(GOUGH_PYTHON_FOUND OFF)
if(GOUGH_PYTHON_PROGRAM)
    execute_process(COMMAND ${GOUGH_PYTHON_PROGRAM} -c
        "import numpy, sys, sysconfig; assert sys.version_info >= (3, 11); print(sysconfig.get_path('include'))"
        OUTPUT_VARIABLE GOUGH_PYTHON_HEADERS OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed AND EXISTS ${GOUGH_PYTHON_HEADERS}/Python.h)
        set(GOUGH_PYTHON_FOUND ON)
    endif()
endif()
if(NOT GOUGH_PYTHON_FOUND)
    set(missing "No Python 3.11 or later with numpy and headers (Debian packages python3-dev and python3-numpy)")
    message(STATUS "${missing}: building without the package for Python")
    add_custom_target(gough_python) # has nothing to build
    add_custom_target(gough_wheel COMMAND ${CMAKE_COMMAND} -E echo "${missing}: there is no wheel" COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
    return()
endif()

file(GLOB GOUGH_PYTHON_SOURCES CONFIGURE_DEPENDS python/module/*.c)
file(GLOB GOUGH_PYTHON_FILES CONFIGURE_DEPENDS python/gough/*.py python/gough/py.typed)
list(APPEND GOUGH_PYTHON_FILES ${PROJECT_SOURCE_DIR}/src/figure/palette.def)
set(GOUGH_PYTHON_FOLDER ${PROJECT_BINARY_DIR}/python)

# It takes the libraries in, so that a wheel is one file that needs none of them installed.
add_library(gough_python_module MODULE ${GOUGH_PYTHON_SOURCES})
set_target_properties(gough_python_module PROPERTIES PREFIX "" OUTPUT_NAME _gough SUFFIX .abi3.so
    LIBRARY_OUTPUT_DIRECTORY ${GOUGH_PYTHON_FOLDER}/gough)
target_include_directories(gough_python_module SYSTEM PRIVATE ${GOUGH_PYTHON_HEADERS})
target_link_libraries(gough_python_module PRIVATE gough_files)
set_source_files_properties(python/module/module.c PROPERTIES COMPILE_OPTIONS -Wno-pedantic) # Python's types keep functions as void *
target_link_options(gough_python_module PRIVATE -Wl,--exclude-libs,ALL)

# What is written in Python lies beside it, and so does the command, which the rarer verbs run.
set(copied)
foreach(file IN LISTS GOUGH_PYTHON_FILES)
    get_filename_component(name ${file} NAME)
    add_custom_command(OUTPUT ${GOUGH_PYTHON_FOLDER}/gough/${name}
        COMMAND ${CMAKE_COMMAND} -E copy ${file} ${GOUGH_PYTHON_FOLDER}/gough/${name} DEPENDS ${file} VERBATIM)
    list(APPEND copied ${GOUGH_PYTHON_FOLDER}/gough/${name})
endforeach()
add_custom_command(OUTPUT ${GOUGH_PYTHON_FOLDER}/gough/command/gough
    COMMAND ${CMAKE_COMMAND} -E make_directory ${GOUGH_PYTHON_FOLDER}/gough/command
    COMMAND ${CMAKE_STRIP} -o ${GOUGH_PYTHON_FOLDER}/gough/command/gough $<TARGET_FILE:gough_command>
    DEPENDS gough_command VERBATIM)
add_custom_target(gough_python ALL DEPENDS gough_python_module ${copied} ${GOUGH_PYTHON_FOLDER}/gough/command/gough)

# make python
foreach(file setup.py pyproject.toml)
    configure_file(python/${file} ${GOUGH_PYTHON_FOLDER}/${file} @ONLY)
endforeach()
add_custom_target(gough_wheel
    COMMAND ${GOUGH_PYTHON_PROGRAM} setup.py -q bdist_wheel --dist-dir ${PROJECT_BINARY_DIR}
    DEPENDS gough_python WORKING_DIRECTORY ${GOUGH_PYTHON_FOLDER} VERBATIM)
