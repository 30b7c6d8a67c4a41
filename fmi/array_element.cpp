#include "fmi/array_element.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace ballbot {

std::optional<std::pair<std::string, std::string>> splitElement(const std::string& name) {
  const std::size_t open = name.rfind('[');
  if (open == std::string::npos || open == 0 || name.back() != ']') return std::nullopt;
  return std::pair(name.substr(0, open), name.substr(open + 1, name.size() - open - 2));
}

std::optional<std::size_t> wholeNumber(const std::string& text) {
  std::int32_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  const bool plain = error == std::errc() && stopped == end && text[0] != '-' &&
                     (text[0] != '0' || text.size() == 1);
  return plain ? std::optional<std::size_t>(value) : std::nullopt;
}

std::optional<std::size_t> elementOffset(const std::string& indices,
                                         const std::vector<std::size_t>& dimensions,
                                         std::size_t first_index) {
  std::vector<std::size_t> at;
  for (std::size_t begin = 0; begin <= indices.size();) {
    const std::size_t comma = std::min(indices.find(',', begin), indices.size());
    const auto index = wholeNumber(indices.substr(begin, comma - begin));
    if (!index || *index < first_index) return std::nullopt;
    at.push_back(*index - first_index);
    begin = comma + 1;
  }
  std::size_t size = 1;
  for (const std::size_t dimension : dimensions) size *= dimension;
  if (at.size() == 1) return at[0] < size ? std::optional<std::size_t>(at[0]) : std::nullopt;
  if (at.size() != dimensions.size()) return std::nullopt;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i] >= dimensions[i]) return std::nullopt;
    offset = offset * dimensions[i] + at[i];
  }
  return offset;
}

}  // namespace ballbot
