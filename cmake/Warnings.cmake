add_library(ballbot_warnings INTERFACE)
add_library(ballbot::warnings ALIAS ballbot_warnings)
# Without the signs of indices: docs/architecture.md#what-compilers-and-linters-hold says why.
target_compile_options(ballbot_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                                  -Wno-sign-conversion)
if(BALLBOT_WARNINGS_AS_ERRORS)
  target_compile_options(ballbot_warnings INTERFACE -Werror)
endif()

# ballbot_library(NAME SOURCES ... PUBLIC ... PRIVATE ...): one folder, one target, one alias.
function(ballbot_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(ballbot_${name} STATIC ${ARG_SOURCES})
  add_library(ballbot::${name} ALIAS ballbot_${name})
  target_include_directories(ballbot_${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(ballbot_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ballbot::warnings ${ARG_PRIVATE})
endfunction()
