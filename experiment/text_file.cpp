#include "experiment/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

std::string readTextFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) {
    if (in && in.peek() == std::char_traits<char>::eof()) return "";
    throw InputError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  }
  return text.str();
}

void writeTextFile(const std::string& path, const std::string& text) {
  const std::string half = path + ".part";
  std::ofstream out(half, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  std::error_code failed;
  if (out) std::filesystem::rename(half, path, failed);
  if (!out || failed) {
    const int reason = failed ? failed.value() : errno;
    std::filesystem::remove(half, failed);
    throw OutputError(fmt::format("{}: cannot be written: {}. Is there room, and may this user write here?",
                                  path, std::strerror(reason)));
  }
}

}  // namespace ballbot
