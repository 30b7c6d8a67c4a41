# Every package this project links, in one place. All come from Debian 12.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(urdfdom REQUIRED)
find_package(SUNDIALS REQUIRED)
find_package(Simbody REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(LCM REQUIRED IMPORTED_TARGET lcm)
pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
find_package(HDF5 REQUIRED COMPONENTS C)

# Debian's Simbody is built without NDEBUG and its classes change layout with it, so whatever
# includes Simbody must be compiled without NDEBUG too. Its headers warn: SYSTEM.
add_library(ballbot_simbody INTERFACE)
target_include_directories(ballbot_simbody SYSTEM INTERFACE ${Simbody_INCLUDE_DIR})
target_compile_options(ballbot_simbody INTERFACE -UNDEBUG)
target_link_libraries(ballbot_simbody INTERFACE ${Simbody_LIBRARIES})
