#include "core/yaml_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/config_node.hpp"

namespace ballbot {
namespace {

std::string quotedText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// Whether these bytes, written bare, are read back as they are: as a word or a number, not as
/// nothing, a list item, a document's end or an alias.
bool isPlain(const std::string& text) {
  for (const char* nothing : {"", "~", "null", "Null", "NULL"}) {
    if (text == nothing) return false;
  }
  const bool safe = std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '.' || c == '+' || c == '-' || c == '/';
  });
  return safe && text.find_first_not_of("-.") != std::string::npos;
}

}  // namespace

std::string yamlText(const std::string& text) { return isPlain(text) ? text : quotedText(text); }

std::string yamlText(const ConfigNode& scalar) {
  return scalar.quoted() ? quotedText(scalar.text()) : yamlText(scalar.text());
}

}  // namespace ballbot
