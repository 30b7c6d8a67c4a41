#include "experiment/build_info.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include "source_revision.inc"

namespace ballbot {

std::vector<std::pair<std::string, std::string>> buildInfo() {
  return {{"version", BALLBOT_VERSION},
          {"revision", kSourceRevision},
          {"compiler", "GCC " __VERSION__},
          {"build_type", BALLBOT_BUILD_TYPE},
          {"simbody", BALLBOT_SIMBODY},
          {"sundials", BALLBOT_SUNDIALS_VERSION},
          {"lcm", BALLBOT_LCM_VERSION},
          {"eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
}

}  // namespace ballbot
