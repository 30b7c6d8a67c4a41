#include "hil/rehearsal/fault_table.hpp"

#include <algorithm>

#include "hil/rehearsal/trial.hpp"

namespace ballbot {
namespace {

const char* expectedText(Reaction reaction) {
  switch (reaction) {
    case Reaction::kOff:
      return "torque off";
    case Reaction::kDampThenOff:
      return "damping, then torque off";
    case Reaction::kSaid:
      return "says that torque is on";
  }
  return "";
}

bool isAllowed(const FaultCase& fault, const std::string& check) {
  if (fault.without_master) return true;  // nobody there to say anything
  if (fault.reasons.empty()) return check == checkOf(BenchFault::kNone).name;
  return std::any_of(fault.reasons.begin(), fault.reasons.end(),
                     [&](BenchFault reason) { return check == checkOf(reason).name; });
}

bool holds(const FaultCase& fault, const FaultRow& row, bool damped) {
  const bool honest = !(row.says_off && row.torque_on);
  if (!honest || !isAllowed(fault, row.check)) return false;
  // A master that hangs says nothing at all; every other run ends with a word and a code.
  if (!fault.without_master && row.exit_code == 0) return false;
  const bool loud = row.exit_code == static_cast<int>(ExitCode::kTorqueNotOff);
  if (fault.reaction == Reaction::kSaid) return loud;
  return row.measured_cycles >= 0 && row.measured_cycles <= row.bound_cycles &&
         (loud || row.says_off || fault.without_master) &&
         (damped || fault.reaction != Reaction::kDampThenOff);
}

}  // namespace

std::vector<FaultCase> allCases() {
  std::vector<FaultCase> all;
  for (auto group : {driveCases(), statusCases(), encoderCases(), pdoCases(), imuCases(),
                     busCases(), intruderCases(), commandCases(), wayDownCases()}) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

FaultRow rehearse(const FaultCase& fault, RunnerKind kind) {
  Trial trial({{&fault, 0}}, kind);
  FaultRow row = trial.run();
  row.fault = fault.name;
  row.expected = expectedText(fault.reaction);
  row.held = holds(fault, row, trial.damped() || kind == RunnerKind::kStepped);
  return row;
}

std::vector<FaultRow> rehearseFaults() {
  std::vector<FaultRow> rows;
  for (const FaultCase& fault : allCases()) {
    if (fault.stepped) rows.push_back(rehearse(fault, RunnerKind::kStepped));
    if (fault.real_time) rows.push_back(rehearse(fault, RunnerKind::kRealTime));
  }
  return rows;
}

}  // namespace ballbot
