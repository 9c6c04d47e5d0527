# Three libraries: the core (rooms base to batch: no dependency but the C library and libquadmath); over it the analysis of
# stability and the search for designs (linear to design: LAPACK, NLopt); over both files and figures (study to page). Each is
# compiled once, as position-independent
# code with only GOUGH_API visible, and serves as a static library (command, tests) and as a shared one (installed).
file(GLOB GOUGH_HEADERS CONFIGURE_DEPENDS include/gough/*.h)
file(GLOB GOUGH_HEADER_TABLES CONFIGURE_DEPENDS include/gough/*.def)

include(cmake/edition.cmake)
gough_edition(GOUGH_EDITION ${GOUGH_HEADERS} ${GOUGH_HEADER_TABLES})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${GOUGH_HEADERS} ${GOUGH_HEADER_TABLES})
configure_file(cmake/version.h.in ${PROJECT_BINARY_DIR}/include/gough/version.h @ONLY)
file(GLOB GOUGH_CORE_SOURCES CONFIGURE_DEPENDS
    src/base/*.c src/kernel/*.c src/drive/*.c src/program/*.c src/plant/*.c src/control/*.c src/model/*.c src/pose/*.c src/workspace/*.c src/cueing/*.c src/integrate/*.c src/run/*.c src/batch/*.c)
file(GLOB GOUGH_ANALYSE_SOURCES CONFIGURE_DEPENDS src/linear/*.c src/floquet/*.c src/map/*.c src/tune/*.c src/design/*.c)
# The core does not show its inner functions: what the others need of them is compiled into them again.
list(APPEND GOUGH_ANALYSE_SOURCES ${PROJECT_SOURCE_DIR}/src/program/appointments.c ${PROJECT_SOURCE_DIR}/src/base/crew.c
    ${PROJECT_SOURCE_DIR}/src/control/program_lack.c)
file(GLOB GOUGH_FILES_SOURCES CONFIGURE_DEPENDS
    src/study/*.c src/table/*.c src/sweep/*.c src/figure/*.c src/page/*.c)
list(APPEND GOUGH_FILES_SOURCES ${PROJECT_SOURCE_DIR}/src/base/crew.c)

# What steps is worth more of the compiler's time; the bits stay.
set_source_files_properties(src/batch/batch_double.c src/batch/batch_lanes_2.c src/batch/fleet_lanes_2.c src/run/run_double.c
    src/map/lane_matrices_double.c src/map/lane_matrices_2.c
    PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")

# Lanes of 4 and 8 have the instructions they need, in files of their own; which of them runs is chosen by the processor.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(src/batch/batch_lanes_4.c src/batch/fleet_lanes_4.c src/map/lane_matrices_4.c
        PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-mavx2")
    set_source_files_properties(src/batch/batch_lanes_8.c src/batch/fleet_lanes_8.c src/map/lane_matrices_8.c
        PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-mavx512f;-mavx512dq;-mavx512vl")
else()
    list(FILTER GOUGH_CORE_SOURCES EXCLUDE REGEX "(batch|fleet)_lanes_[48]\\.c$")
    list(FILTER GOUGH_ANALYSE_SOURCES EXCLUDE REGEX "lane_matrices_[48]\\.c$")
endif()

# The same for one run, and for its stages made ready side by side.
set_source_files_properties(src/run/prefetch_lanes_2.c PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(src/run/prefetch_lanes_4.c src/run/run_double_4.c
        PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-mavx2")
    set_source_files_properties(src/run/prefetch_lanes_8.c src/run/run_double_8.c
        PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-mavx512f;-mavx512dq;-mavx512vl")
else()
    list(FILTER GOUGH_CORE_SOURCES EXCLUDE REGEX "(prefetch_lanes|run_double)_[48]\\.c$")
endif()

# The same for the paths to all poses; what is certified on the way of one pose is worth as much.
set_source_files_properties(src/pose/pose_double.c src/pose/poses_all.c src/pose/track_double.c src/pose/track_lanes_2.c
    PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(src/pose/track_lanes_4.c PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-mavx2")
    set_source_files_properties(src/pose/track_lanes_8.c
        PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-mavx512f;-mavx512dq;-mavx512vl")
else()
    list(FILTER GOUGH_CORE_SOURCES EXCLUDE REGEX "track_lanes_[48]\\.c$")
endif()

# And for boxes of poses, of which a search tests many.
file(GLOB workspace_sources src/workspace/*.c)
set_source_files_properties(${workspace_sources} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")

# Products of complex numbers are those of finite ones, without the calls by which C recovers infinities: twice as fast, and finite
# numbers keep their bits but for quotients, which are scaled in another way.
include(CheckCCompilerFlag)
check_c_compiler_flag(-fcx-fortran-rules GOUGH_HAS_PLAIN_COMPLEX)
if(GOUGH_HAS_PLAIN_COMPLEX)
    file(GLOB complex_sources src/*/*_complex.c)
    set_source_files_properties(${complex_sources} PROPERTIES COMPILE_OPTIONS "-fcx-fortran-rules")
endif()

# gough_room_libraries(SUFFIX [FLAGS…]): the static libraries gough_core<SUFFIX>, gough_analyse<SUFFIX> and gough_files<SUFFIX>.
# A library with a suffix compiles only the scalar instances of the texts and those of 2 lanes; the others (4 and 8 lanes, quadruple and
# complex numbers) it takes as they are from the library without. It starts at most 2 lanes by itself.
function(gough_room_libraries suffix)
    set(core ${GOUGH_CORE_SOURCES})
    set(analyse ${GOUGH_ANALYSE_SOURCES})
    set(files ${GOUGH_FILES_SOURCES})
    set(parts core analyse files)
    if(GOUGH_CORE_ONLY)
        set(parts core)
    endif()
    set(other_instances "_([48]|quad|complex)\\.c")
    foreach(part IN LISTS parts)
        if(suffix)
            list(FILTER ${part} EXCLUDE REGEX "${other_instances}$")
        endif()
        add_library(gough_${part}_objects${suffix} OBJECT ${GOUGH_HEADERS} ${${part}})
        set_target_properties(gough_${part}_objects${suffix} PROPERTIES POSITION_INDEPENDENT_CODE ON)
        target_compile_definitions(gough_${part}_objects${suffix} PRIVATE GOUGH_SHARED)
        target_link_libraries(gough_${part}_objects${suffix} PRIVATE gough_flags ${ARGN})
        add_library(gough_${part}${suffix} STATIC $<TARGET_OBJECTS:gough_${part}_objects${suffix}>)
        if(suffix)
            target_compile_definitions(gough_${part}_objects${suffix} PRIVATE GOUGH_WIDEST=2)
            target_sources(gough_${part}${suffix} PRIVATE
                "$<FILTER:$<TARGET_OBJECTS:gough_${part}_objects>,INCLUDE,${other_instances}>")
        endif()
        set_target_properties(gough_${part}${suffix} PROPERTIES LINKER_LANGUAGE C)
    endforeach()
    target_link_libraries(gough_core${suffix} PUBLIC gough_flags ${ARGN} ${GOUGH_MATH})
    if(GOUGH_CORE_ONLY)
        return()
    endif()
    target_link_libraries(gough_analyse_objects${suffix} PRIVATE PkgConfig::LAPACKE PkgConfig::NLOPT)
    target_link_libraries(gough_files_objects${suffix} PRIVATE PkgConfig::LIBFYAML PkgConfig::HDF5)
    target_link_libraries(gough_analyse${suffix} PUBLIC gough_core${suffix} PRIVATE PkgConfig::LAPACKE PkgConfig::NLOPT)
    target_link_libraries(gough_files${suffix} PUBLIC gough_analyse${suffix} PRIVATE PkgConfig::LIBFYAML PkgConfig::HDF5)
endfunction()

gough_room_libraries("")

# Installed: each library as an archive and, unless BUILD_SHARED_LIBS is off, as a shared one: gough, gough-analyse, gough-files. A
# program linked to the core's archive with --gc-sections has only the functions that it calls; inner names of the archives cannot clash
# with those of the program.
target_compile_options(gough_core_objects PRIVATE -ffunction-sections -fdata-sections)
set(GOUGH_ARCHIVES)
set(pairs core|gough analyse|gough-analyse files|gough-files)
if(GOUGH_CORE_ONLY)
    set(pairs core|gough)
endif()
foreach(pair IN LISTS pairs)
    string(REPLACE "|" ";" pair ${pair})
    list(GET pair 0 part)
    list(GET pair 1 name)
    set(archive ${PROJECT_BINARY_DIR}/lib${name}.a)
    add_custom_command(OUTPUT ${archive}
        COMMAND ${CMAKE_COMMAND} -DFILE=${archive} "-DOBJECTS=$<TARGET_OBJECTS:gough_${part}_objects>"
                -DEDITION=${GOUGH_EDITION} -DREADELF=${CMAKE_READELF} -DOBJCOPY=${CMAKE_OBJCOPY} -DAR=${CMAKE_AR} -P ${PROJECT_SOURCE_DIR}/cmake/archive.cmake
        DEPENDS gough_${part}_objects $<TARGET_OBJECTS:gough_${part}_objects> ${PROJECT_SOURCE_DIR}/cmake/archive.cmake
        VERBATIM)
    list(APPEND GOUGH_ARCHIVES ${archive})
endforeach()
add_custom_target(gough_archive ALL DEPENDS ${GOUGH_ARCHIVES})

if(GOUGH_CORE_ONLY)
    return()
endif()
if(NOT BUILD_SHARED_LIBS)
    foreach(library gough_shared gough_analyse_shared gough_files_shared)
        add_custom_target(${library}) # has nothing to build
    endforeach()
    return()
endif()
add_library(gough_shared SHARED $<TARGET_OBJECTS:gough_core_objects>)
add_library(gough_analyse_shared SHARED $<TARGET_OBJECTS:gough_analyse_objects>)
add_library(gough_files_shared SHARED $<TARGET_OBJECTS:gough_files_objects>)
set_target_properties(gough_shared PROPERTIES OUTPUT_NAME gough EXPORT_NAME gough)
set_target_properties(gough_analyse_shared PROPERTIES OUTPUT_NAME gough-analyse EXPORT_NAME analyse)
set_target_properties(gough_files_shared PROPERTIES OUTPUT_NAME gough-files EXPORT_NAME files)
foreach(library gough_shared gough_analyse_shared gough_files_shared)
    set_target_properties(${library} PROPERTIES
        LINKER_LANGUAGE C VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    target_include_directories(${library} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_options(${library} PRIVATE $<$<NOT:$<BOOL:${GOUGH_SANITIZE}>>:-Wl,--no-undefined>)
endforeach()
target_link_libraries(gough_shared PRIVATE $<BUILD_INTERFACE:gough_flags> ${GOUGH_MATH})
target_link_libraries(gough_analyse_shared PUBLIC gough_shared
    PRIVATE $<BUILD_INTERFACE:gough_flags> $<BUILD_INTERFACE:PkgConfig::LAPACKE> $<BUILD_INTERFACE:PkgConfig::NLOPT> ${GOUGH_MATH})
target_link_libraries(gough_files_shared PUBLIC gough_analyse_shared
    PRIVATE $<BUILD_INTERFACE:gough_flags> $<BUILD_INTERFACE:PkgConfig::LIBFYAML> $<BUILD_INTERFACE:PkgConfig::HDF5> ${GOUGH_MATH})
