#pragma once

#include <string>

namespace ballbot {

/// Writes a file whole or not at all: beside its place first, then into it. What stands there and
/// is no file (a device, a pipe) is never replaced but written to.
/// @return 0, or the error number of what went wrong
int writeWholeFile(const std::string& path, const std::string& bytes);

}  // namespace ballbot
