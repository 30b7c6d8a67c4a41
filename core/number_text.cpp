#include "core/number_text.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace ballbot {

std::string numberText(double value) { return fmt::format("{}", value); }

std::optional<double> parseNumber(std::string_view text) {
  // from_chars knows no plus, and must not see a second sign behind it.
  if (text.substr(0, 1) == "+") {
    text.remove_prefix(1);
    if (text.substr(0, 1) == "-") return std::nullopt;
  }
  // Not strtod: it obeys the locale of the process, and an FMU lives in other people's processes.
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parseWhole(std::string_view text) {
  const std::optional<double> value = parseNumber(text);
  if (!value || !(std::abs(*value) <= kLargestWhole) || *value != std::floor(*value)) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(*value);
}

// A division is rounded once; a product with 1e-9, which no double is, twice.
double decimalSeconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

}  // namespace ballbot
