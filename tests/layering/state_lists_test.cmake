# What a class saves, restores and has hashed is one list, its visitState(). Who writes or reads a
# blob by hand keeps two, and one day they differ: so only the visitors know these two classes, and
# the messages between an FMU's process and this one, which are no state.
cmake_minimum_required(VERSION 3.25)
set(by_hand "BlobWriter|BlobReader")
set(allowed "^core/|^fmi/fmu_(wire|process|server)[.]|^tests/core/")

set(seen 0)
file(GLOB files RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/*/*.[hc]pp ${SOURCE_DIR}/*/*/*.[hc]pp
     ${SOURCE_DIR}/*/*/*/*.[hc]pp)
list(FILTER files EXCLUDE REGEX "^build|/node_modules/|^tests/layering/forbidden/")
foreach(file ${files})
  math(EXPR seen "${seen} + 1")
  file(STRINGS ${SOURCE_DIR}/${file} found REGEX "${by_hand}")
  if(NOT file MATCHES "${allowed}" AND found MATCHES "${by_hand}")
    message(SEND_ERROR "${file} names ${CMAKE_MATCH_0}. Name the members once, in a visitState(), "
                       "and use saveStateOf() and restoreStateOf().")
  endif()
endforeach()
if(seen EQUAL 0)
  message(SEND_ERROR "No source file found below ${SOURCE_DIR}: this test looked in the wrong place.")
endif()
message(STATUS "${seen} files looked at")
