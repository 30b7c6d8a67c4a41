# lcm_types(TARGET file.lcm...): C++ bindings of LCM types as an interface library. The generated
# headers land in <build>/lcm/<package>/ and are included as "<package>/<type>.hpp".
find_program(LCM_GEN lcm-gen REQUIRED)

function(lcm_types target package)
  set(out ${CMAKE_BINARY_DIR}/lcm)
  set(headers)
  foreach(file ${ARGN})
    get_filename_component(type ${file} NAME_WE)
    set(header ${out}/${package}/${type}.hpp)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${LCM_GEN} -x --cpp-std c++11 --cpp-hpath ${out} ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      DEPENDS ${file}
      COMMENT "LCM type ${package}.${type}")
    list(APPEND headers ${header})
  endforeach()
  add_custom_target(${target}_generate DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_generate)
  target_include_directories(${target} SYSTEM INTERFACE ${out})
  target_link_libraries(${target} INTERFACE PkgConfig::LCM)
endfunction()
