#include "core/printable_text.hpp"

#include <cstddef>

namespace ballbot {
namespace {

unsigned byteAt(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

// Length of the UTF-8 character that begins at `i`; 0 if none does, or one that controls.
std::size_t printableLength(std::string_view text, std::size_t i) {
  const unsigned first = byteAt(text, i);
  if (first < 0x80) return first == '\n' || (first >= 0x20 && first != 0x7F) ? 1 : 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  unsigned code = first & (0x7FU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    const unsigned next = byteAt(text, i + k);
    if ((next & 0xC0U) != 0x80) return 0;
    code = code << 6 | (next & 0x3FU);
  }
  const unsigned smallest = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool controls = code < 0xA0;  // U+0080 to U+009F act like ESC and a letter
  // U+202A to 202E and 2066 to 2069 turn the direction of writing.
  const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return code < smallest || code > 0x10FFFF || surrogate || controls || turns ? 0 : length;
}

}  // namespace

std::string printableText(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = printableLength(text, i);
    length > 0 ? out.append(text, i, length) : out.append(1, '?');
    i += length > 0 ? length : 1;
  }
  return out;
}

}  // namespace ballbot
