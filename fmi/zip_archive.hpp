#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ballbot {

/// One file of a zip archive.
struct ZipEntry {
  std::string name;  ///< with '/' between folders
  std::string content;
  bool executable = false;
};

/// Writes a zip file: deflated, no time stamps, entries in the order given, so that equal contents
/// give equal bytes. @throw OutputError
void writeZip(const std::string& path, const std::vector<ZipEntry>& entries);

/// One file out of an archive.
/// @param longest bytes that it may unpack to: a few of an archive can unpack to any number
/// @throw InputError if the archive is none, or has no such file, or a longer one.
std::string readFromZip(const std::string& path, const std::string& name, std::uint64_t longest);

/// Whether the archive has such a file. @throw InputError if the archive is none.
bool zipHas(const std::string& path, const std::string& name);

/// What an archive may unpack to.
struct UnpackLimits {
  std::uint64_t bytes = std::uint64_t{4} << 30;
  std::int64_t entries = 100'000;
};

/// Unpacks everything into `folder`, which must exist. Files may be executed that may be so in the
/// archive.
/// @throw InputError if the archive is none, is beyond the limits, or an entry would land outside
///        `folder` or cannot be a file there; OutputError if there is no space.
void unpackZip(const std::string& path, const std::string& folder, const UnpackLimits& limits = {});

}  // namespace ballbot
