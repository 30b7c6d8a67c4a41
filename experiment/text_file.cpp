#include "experiment/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/whole_file.hpp"

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
  if (const int reason = writeWholeFile(path, text)) {
    throw OutputError(
        fmt::format("{}: cannot be written: {}. Is there room, and may this user write here?", path,
                    std::strerror(reason)));
  }
}

}  // namespace ballbot
