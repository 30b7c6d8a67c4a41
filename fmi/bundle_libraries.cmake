# Run at build time: puts the FMU's shared objects, and everything they need beyond the C and C++
# runtime that every Linux has, into one folder, so that they run on a machine without Simbody.
#   cmake "-DMODULES=entry.so;core.so" -DOUTPUT=folder -DPATCHELF=... -DSANITIZED=-1
#         -P bundle_libraries.cmake
# The copies get names of their own. A host that has loaded another liblapack.so.3, say, would lend
# it to us otherwise, and results would depend on who imports the FMU.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${OUTPUT})
file(MAKE_DIRECTORY ${OUTPUT}/binaries ${OUTPUT}/licenses)
if(NOT SANITIZED EQUAL -1)
  file(COPY ${MODULES} DESTINATION ${OUTPUT}/binaries)
  return()
endif()
file(GET_RUNTIME_DEPENDENCIES MODULES ${MODULES}
     RESOLVED_DEPENDENCIES_VAR found UNRESOLVED_DEPENDENCIES_VAR missing
     POST_EXCLUDE_REGEXES "/(ld-linux[^/]*|libc|libm|libdl|librt|libpthread|libstdc\\+\\+|libgcc_s)\\.so[^/]*$")
if(missing)
  message(FATAL_ERROR "${MODULES} need what is not there: ${missing}")
endif()

set(rename)
set(copies)
foreach(library ${found})
  get_filename_component(name ${library} NAME)
  file(REAL_PATH ${library} real)
  set(copy ${OUTPUT}/binaries/ballbot-${name})
  configure_file(${real} ${copy} COPYONLY)
  file(CHMOD ${copy} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ WORLD_READ)
  list(APPEND copies ${copy})
  list(APPEND rename --replace-needed ${name} ballbot-${name})
  # Whose work it is goes along with it.
  execute_process(COMMAND dpkg -S ${real} OUTPUT_VARIABLE owner ERROR_QUIET)
  if(owner MATCHES "^([^:]+):")
    if(EXISTS /usr/share/doc/${CMAKE_MATCH_1}/copyright)
      file(COPY_FILE /usr/share/doc/${CMAKE_MATCH_1}/copyright ${OUTPUT}/licenses/${CMAKE_MATCH_1}.txt)
    endif()
  else()
    get_filename_component(folder ${real} DIRECTORY)
    if(EXISTS ${folder}/../copyright)  # a library of cmake/native_simbody.sh
      file(COPY_FILE ${folder}/../copyright ${OUTPUT}/licenses/${name}.txt)
    endif()
  endif()
endforeach()

# Ours, and that of the headers compiled in: no library stands for them.
foreach(name LICENSE NOTICE)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/../${name} ${OUTPUT}/licenses/ballbot-${name}.txt COPYONLY)
endforeach()
foreach(package libeigen3-dev librandom123-dev)
  if(EXISTS /usr/share/doc/${package}/copyright)
    file(COPY_FILE /usr/share/doc/${package}/copyright ${OUTPUT}/licenses/${package}.txt)
  endif()
endforeach()

set(own)
foreach(module ${MODULES})
  get_filename_component(name ${module} NAME)
  configure_file(${module} ${OUTPUT}/binaries/${name} COPYONLY)
  list(APPEND own ${OUTPUT}/binaries/${name})
endforeach()
# One kind of change per call: patchelf 0.14 mixes a new path and new names up.
foreach(file ${copies} ${own})
  get_filename_component(name ${file} NAME)
  if(file IN_LIST copies)
    execute_process(COMMAND ${PATCHELF} --set-soname ${name} ${file} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  execute_process(COMMAND ${PATCHELF} ${rename} ${file} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${PATCHELF} --set-rpath $ORIGIN ${file} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${PATCHELF} --print-rpath ${file} OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT path STREQUAL "$ORIGIN")
    message(FATAL_ERROR "${file}: its search path is '${path}', must be $ORIGIN")
  endif()
endforeach()
