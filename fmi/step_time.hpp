#pragma once

#include <optional>
#include <string>

#include "core/time.hpp"

namespace ballbot {

/// Where a step leads whose time and size came as seconds, or in words why it is none.
struct StepTarget {
  SimTime end{};
  std::string refusal;  ///< empty if the step is good
};

/// Importers reckon time in doubles: by adding steps up, or by multiplying, so that 0.01 s arrives
/// as 0.009999999999999998. Inside, time is whole nanoseconds. The end of the step is the nearest
/// whole microsecond where it is meant (off by less than 1e-9 of the time), else the nearest
/// nanosecond; so steps neither drift nor get lost, however many there are.
///
/// Refused: numbers that are not finite, steps that are not positive or below a nanosecond, a start
/// that is not `now` to 1e-9 of the time (1 ns at least), an end after `stop`.
StepTarget stepTarget(SimTime now, double communication_point, double step_size,
                      std::optional<SimTime> stop);

/// The double nearest to a time: 0.7, where 1e-9 * 700000000 is 0.7000000000000001.
inline double secondsOf(SimTime t) { return static_cast<double>(toNs(t)) / 1e9; }

/// A time as an importer gives it. @throw InputError if it is not finite or over 1e8 s.
SimTime timeFromSeconds(const char* what, double seconds);

}  // namespace ballbot
