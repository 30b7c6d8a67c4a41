#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace ballbot {

/// Simulated time, in whole nanoseconds. There is no `now()`: only the step master moves time,
/// so code that simulates or controls cannot ask a clock by mistake.
struct SimClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::duration<rep, period>;
  using time_point = std::chrono::time_point<SimClock, duration>;
  static constexpr bool is_steady = true;
};

using SimTime = SimClock::time_point;
using SimDuration = SimClock::duration;

constexpr SimTime kSimStart{};

constexpr SimTime simTimeFromNs(std::int64_t ns) { return SimTime{SimDuration{ns}}; }
constexpr std::int64_t toNs(SimTime t) { return t.time_since_epoch().count(); }
constexpr std::int64_t toNs(SimDuration d) { return d.count(); }

/// Seconds are for equations and people; nothing schedules with them.
constexpr double toSeconds(SimDuration d) { return 1e-9 * static_cast<double>(d.count()); }
constexpr double toSeconds(SimTime t) { return toSeconds(t.time_since_epoch()); }

/// The nearest whole nanosecond to `seconds`.
/// @throw Error if `seconds` is not finite or exceeds 292 years.
SimDuration durationFromSeconds(double seconds);

/// "1.2346 s", "400 us", "14 ms": the shortest exact unit, for messages to people.
std::string toText(SimDuration d);
std::string toText(SimTime t);

}  // namespace ballbot
