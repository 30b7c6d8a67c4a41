#pragma once

#include "core/error.hpp"

namespace ballbot {

/// What `doctor --real-time` is asked.
struct RealtimeDoctorOptions {
  int core = -1;       ///< of the loop; -1: the first isolated one, else the last
  double seconds = 1;  ///< of each of four measurements
  bool json = false;
};

/// Looks at what decides how late a bench's loop is on this machine, measures what each is worth,
/// and prints it. @return kPassed, or kRequirementMissed if something makes the loop late.
ExitCode realtimeDoctor(const RealtimeDoctorOptions& options);

}  // namespace ballbot
