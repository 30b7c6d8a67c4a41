#pragma once

#include <string>

namespace ballbot {

/// The whole file. @throw InputError if it cannot be read.
std::string readTextFile(const std::string& path);

/// Writes the whole file or nothing: a reader never sees half of it. @throw OutputError
void writeTextFile(const std::string& path, const std::string& text);

}  // namespace ballbot
