#include "core/time.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

SimDuration durationFromSeconds(double seconds) {
  const double ns = seconds * 1e9;
  if (!std::isfinite(ns) || std::abs(ns) > 9.2e18) {
    throw InputError(fmt::format("{} s is not a time this program can represent", seconds));
  }
  return SimDuration{std::llround(ns)};
}

std::string toText(SimDuration d) {
  const std::int64_t ns = d.count();
  if (ns == 0) return "0 s";
  if (ns % 1000 != 0) return fmt::format("{} ns", ns);
  if (ns % 1'000'000 != 0 && std::abs(ns) < 1'000'000) return fmt::format("{} us", ns / 1000);
  if (std::abs(ns) < 1'000'000'000) return fmt::format("{} ms", static_cast<double>(ns) / 1e6);
  return fmt::format("{} s", static_cast<double>(ns) / 1e9);
}

std::string toText(SimTime t) { return fmt::format("{:.6f} s", toSeconds(t)); }

}  // namespace ballbot
