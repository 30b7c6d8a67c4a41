#include "fmi/file_uri.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::string fileUri(const std::string& path) {
  static constexpr const char* kPlain = "/-._~";
  std::string out = "file://";
  for (const char c : path) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    const bool plain = letter || (c != '\0' && std::string(kPlain).find(c) != std::string::npos);
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string resourcePath(const char* location) {
  if (!location || *location == '\0') {
    throw InputError(
        "no resource location was given; this FMU needs the files of its resources folder");
  }
  std::string path = location;
  if (path.rfind("file:", 0) == 0) {
    path.erase(0, 5);
    if (path.rfind("//", 0) == 0) {
      const std::size_t slash = path.find('/', 2);
      const std::string host = path.substr(2, slash == std::string::npos ? slash : slash - 2);
      if (slash == std::string::npos || (!host.empty() && host != "localhost")) {
        throw InputError(fmt::format("resource location '{}' is not on this machine", location));
      }
      path.erase(0, slash);
    }
    std::string decoded;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const bool code = path[i] == '%' && i + 2 < path.size() && hexDigit(path[i + 1]) >= 0 &&
                        hexDigit(path[i + 2]) >= 0;
      decoded +=
          code ? static_cast<char>(16 * hexDigit(path[i + 1]) + hexDigit(path[i + 2])) : path[i];
      if (code) i += 2;
    }
    path = decoded;
  } else if (path.find("://") != std::string::npos) {
    throw InputError(
        fmt::format("resource location '{}' is neither a file URI nor a path", location));
  }
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

}  // namespace ballbot
