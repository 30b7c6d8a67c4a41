#include "core/whole_file.hpp"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace ballbot {
namespace {

int writeInto(const std::string& path, const std::string& bytes) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << bytes;
  file.close();
  if (file) return 0;
  return errno != 0 ? errno : EIO;
}

}  // namespace

int writeWholeFile(const std::string& path, const std::string& bytes) {
  std::error_code unknown;
  const auto there = std::filesystem::status(path, unknown);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    return writeInto(path, bytes);
  }
  const std::string half = path + ".part";
  int failed = writeInto(half, bytes);
  if (failed == 0 && std::rename(half.c_str(), path.c_str()) != 0) failed = errno;
  if (failed != 0) std::remove(half.c_str());
  return failed;
}

}  // namespace ballbot
