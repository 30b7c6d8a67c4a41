#pragma once

#include <string>
#include <vector>

#include "hil/bench_runner.hpp"
#include "hil/commissioning/commissioning_task.hpp"

namespace ballbot {

/// One task and what came of it.
struct CommissioningRow {
  std::string name;  ///< "turn wheel 1", "torque on arm 2"
  bool good = false;
  std::string words;  ///< what was measured, or what is wrong
};

struct CommissioningReport {
  std::vector<CommissioningRow> rows;
  bool torque_was_on = false;
  bool passed = false;  ///< every task of every kind was carried out and was good
};

/// What there is to do on this bench, in order: the stand, each joint by hand, the base about its
/// three axes; then low torque on each drive.
std::vector<CommissioningTask> commissioningTasks(const BenchConfig& config);

/// Finds out whether the bench is the one that its file describes, with the robot held and nobody's
/// controller: identity, sign and counts of each drive by hand and without voltage, axes of the
/// IMU likewise; only if all of that is good, one drive after the other with low torque. Goes on
/// after what is wrong as long as there is no voltage; ends at the first that is wrong under
/// torque. All checks of the bench watch.
/// @throw LostParticipantError if the bench stops while there is no torque, TorqueNotOffError,
///        InterruptedError
CommissioningReport commission(BenchRunner& runner, CommissioningPerson& person);

}  // namespace ballbot
