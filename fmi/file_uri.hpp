#pragma once

#include <string>

namespace ballbot {

/// "file:///tmp/a%20b" for an absolute path.
std::string fileUri(const std::string& path);

/// The path that an importer means by a resource location: a path, or a file URI with percent
/// codes. @throw InputError if it is missing, or a place on another machine.
std::string resourcePath(const char* location);

}  // namespace ballbot
