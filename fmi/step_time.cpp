#include "fmi/step_time.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr double kNanosecond = 1e-9;
constexpr double kMicrosecond = 1e-6;
constexpr double kLongestTime_s = 1e8;  // a double still tells 15 ns apart there
constexpr double kRelativeTolerance = 1e-9;

double tolerance(double seconds) { return kNanosecond + kRelativeTolerance * std::abs(seconds); }

SimTime nearest(double seconds) { return simTimeFromNs(std::llround(1e9 * seconds)); }

}  // namespace

SimTime timeFromSeconds(const char* what, double seconds) {
  if (!(std::abs(seconds) <= kLongestTime_s)) {
    throw InputError(
        fmt::format("{} is {} s, must lie within {} s", what, seconds, kLongestTime_s));
  }
  return nearest(seconds);
}

StepTarget stepTarget(SimTime now, double point, double size, std::optional<SimTime> stop) {
  StepTarget out;
  if (!std::isfinite(point) || std::abs(point) > kLongestTime_s) {
    out.refusal =
        fmt::format("communication point is {} s, must lie within {} s", point, kLongestTime_s);
  } else if (!std::isfinite(size) || size <= 0 || size > kLongestTime_s) {
    out.refusal = fmt::format("step size is {} s, must be above 0 and finite", size);
  } else if (std::abs(point - toSeconds(now)) > tolerance(point)) {
    out.refusal = fmt::format("communication point is {:.9f} s, but the plant stands at {:.9f} s",
                              point, toSeconds(now));
  }
  if (!out.refusal.empty()) return out;

  const double end = point + size;
  const double whole = std::round(end / kMicrosecond) * kMicrosecond;
  const bool meant =
      std::abs(end - whole) <= std::min({tolerance(end), size / 4, kMicrosecond / 4});
  out.end = meant ? simTimeFromNs(1000 * std::llround(end / kMicrosecond)) : nearest(end);
  if (out.end <= now) {
    out.refusal = fmt::format("step size is {} s, must be at least a nanosecond", size);
  } else if (stop && toSeconds(out.end - *stop) > tolerance(end)) {
    out.refusal =
        fmt::format("step to {:.9f} s leads past the stop time {:.9f} s", end, toSeconds(*stop));
  }
  return out;
}

}  // namespace ballbot
