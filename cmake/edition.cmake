# The edition of the interface: a digest of what the public headers declare, whatever their comments say and however they are laid
# out, as a number of 28 bits. It ends the linker's name of each function (include/gough/names.h).
#
# gough_edition(VARIABLE HEADER…). As a script it prints the edition of the headers in a folder: cmake -DFOLDER=… -P edition.cmake
cmake_policy(VERSION 3.25)

function(gough_edition variable)
    set(declared "")
    foreach(header IN LISTS ARGN)
        file(READ ${header} text)
        string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" text "${text}")
        string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
        string(SHA256 text "${text}")
        string(APPEND declared ${text})
    endforeach()
    string(SHA256 declared ${declared})
    string(SUBSTRING ${declared} 0 7 declared)
    math(EXPR edition "0x${declared}")
    set(${variable} ${edition} PARENT_SCOPE)
endfunction()

if(DEFINED CMAKE_SCRIPT_MODE_FILE)
    file(GLOB headers ${FOLDER}/*.h)
    file(GLOB tables ${FOLDER}/*.def)
    gough_edition(edition ${headers} ${tables})
    message(NOTICE "${edition}")
endif()
