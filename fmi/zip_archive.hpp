#pragma once

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

/// One file out of an archive. @throw InputError if the archive is none, or has no such file.
std::string readFromZip(const std::string& path, const std::string& name);

/// Whether the archive has such a file. @throw InputError if the archive is none.
bool zipHas(const std::string& path, const std::string& name);

/// Unpacks everything into `folder`, which must exist.
/// @throw InputError if the archive is none, or an entry would land outside `folder`.
void unpackZip(const std::string& path, const std::string& folder);

}  // namespace ballbot
