#pragma once

#include <utility>

#include "hil/rehearsal/fault_case.hpp"
#include "hil/rehearsal/wire_faults.hpp"

namespace ballbot {

// Short ways to write a row of the table.

using Reasons = std::vector<BenchFault>;
using Start = std::function<void(Rehearsal&)>;

inline FaultCase off(const char* name, int cycles, Reasons reasons, Start start) {
  FaultCase c;
  c.name = name;
  c.detection_cycles = cycles;
  c.reasons = std::move(reasons);
  c.start = std::move(start);
  return c;
}

inline FaultCase damped(const char* name, int cycles, Reasons reasons, Start start) {
  FaultCase c = off(name, cycles, std::move(reasons), std::move(start));
  c.reaction = Reaction::kDampThenOff;
  return c;
}

/// A fault inside the emulated drives.
inline Start inside(EmulatedFault kind, int drive = 1, double value = 0) {
  return [=](Rehearsal& r) { r.drives().inject({0, kind, drive, value}); };
}

/// A change of a drive's TPDO, or of the IMU's, on its way to the master.
// NOLINTNEXTLINE(performance-unnecessary-value-param): the closure keeps it
inline Start onTpdo(int drive, int number, FrameChange change) {
  return [=](Rehearsal& r) { changeToMaster(r, busOfDrive(drive), tpdoOf(drive, number), change); };
}
// NOLINTNEXTLINE(performance-unnecessary-value-param): likewise
inline Start onImu(int number, FrameChange change) {
  return [=](Rehearsal& r) { changeToMaster(r, 0, imuPdo(number), change); };
}
inline Start both(Start a, Start b) {
  return [a = std::move(a), b = std::move(b)](Rehearsal& r) {
    a(r);
    b(r);
  };
}

}  // namespace ballbot
