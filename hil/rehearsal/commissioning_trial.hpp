#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hil/commissioning/commissioning.hpp"
#include "hil/emulator/emulator_config.hpp"
#include "hil/rehearsal/rehearsal.hpp"

namespace ballbot {

/// A bench that is not as its file says, in a way that only commissioning can find: nothing in it
/// contradicts itself.
struct CommissioningCase {
  std::string name;
  /// The task that must find it; empty: nothing is wrong.
  std::string found_by;
  /// The bench as it is: drives and IMU.
  std::function<void(EmulatorConfig&)> emulator = {};
  /// And on the wire.
  std::function<void(Rehearsal&)> wire = {};
};

std::vector<CommissioningCase> commissioningCases();

/// Commissions the default bench with that case, by an emulated person.
/// @param listener  is told what the person is told; null: nobody
CommissioningReport rehearseCommissioning(const CommissioningCase& wrong, RunnerKind kind,
                                          CommissioningPerson* listener = nullptr);

/// The name of the first task that was not good; "" if all were.
std::string foundBy(const CommissioningReport& report);

}  // namespace ballbot
