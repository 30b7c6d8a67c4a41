#include "core/config_values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kMostNameBytes = 100;  // leaves room for what is appended to it

bool isControl(char c) { return (c >= 0 && c < ' ') || c == 0x7f; }

/// Without control characters, which would act on a terminal.
std::string printable(std::string text) {
  std::replace_if(text.begin(), text.end(), isControl, '?');
  return text;
}

}  // namespace

std::int64_t readWhole(ConfigReader& in, const std::string& key, Range range) {
  range.low = std::max(range.low, -kLargestWhole);
  range.high = std::min(range.high, kLargestWhole);
  const double value = in.number(key, range);
  if (value != std::floor(value)) {
    throw InputError(
        fmt::format("{} is {}, must be a whole number", in.at(key), in.raw(key)->text()));
  }
  return static_cast<std::int64_t>(value);
}

std::string readFileName(ConfigReader& in, const std::string& key) {
  const std::string name = in.text(key);
  const bool good =
      !name.empty() && name.size() <= kMostNameBytes && name[0] != '.' && name[0] != '-' &&
      std::none_of(name.begin(), name.end(), [](char c) { return c == '/' || isControl(c); });
  if (!good) {
    throw InputError(fmt::format(
        "{} is '{}', must be the name of a file: 1 to {} bytes, no '/', no '.' or '-' in front",
        in.at(key), printable(name), kMostNameBytes));
  }
  return name;
}

void describeSeed(ConfigVisitor& v, std::uint64_t& seed) {
  auto whole = static_cast<std::int64_t>(seed);
  v.whole(may("seed", "of every noise source"), whole, {0, kInf});
  seed = static_cast<std::uint64_t>(whole);
}

}  // namespace ballbot
