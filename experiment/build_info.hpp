#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ballbot {

/// What this executable was made from, in a fixed order: version, source revision, compiler,
/// build type and the versions of the libraries that take part in the numbers.
std::vector<std::pair<std::string, std::string>> buildInfo();

}  // namespace ballbot
