#include <functional>
#include <utility>

#include "hil/cia402.hpp"
#include "hil/record/fault_plots.hpp"

namespace ballbot {
namespace {

struct Word {
  std::string text;
  LaneTone tone = LaneTone::kQuiet;
};

Word benchWord(const CycleRecord& r) {
  switch (r.action) {
    case SafetyAction::kNoVoltage:
      return r.state == SafetyState::kFault ? Word{"fault, torque off", LaneTone::kBad}
                                            : Word{"no voltage", LaneTone::kQuiet};
    case SafetyAction::kSwitchedOn:
      return {"ready, no torque", LaneTone::kReady};
    case SafetyAction::kZeroTorque:
      return {"engaging", LaneTone::kReady};
    case SafetyAction::kFollow:
      return {"follows the controller", LaneTone::kActive};
    case SafetyAction::kDamp:
      return {"damps", LaneTone::kWarning};
  }
  return {};
}

Word driveWord(const CycleRecord& r, std::size_t drive) {
  if (r.stale[drive] > 0) return {"PDOs missing", LaneTone::kBad};
  const DriveState state = driveState(r.statusword[drive]);
  switch (state) {
    case DriveState::kOperationEnabled:
      return {toText(state), LaneTone::kActive};
    case DriveState::kSwitchedOn:
    case DriveState::kReadyToSwitchOn:
      return {toText(state), LaneTone::kReady};
    case DriveState::kQuickStopActive:
      return {toText(state), LaneTone::kWarning};
    case DriveState::kFault:
    case DriveState::kFaultReactionActive:
    case DriveState::kUnknown:
      return {toText(state), LaneTone::kBad};
    default:
      return {toText(state), LaneTone::kQuiet};
  }
}

Word imuWord(const CycleRecord& r) {
  return r.imu_stale > 0 ? Word{"no new sample", LaneTone::kBad}
                         : Word{"samples", LaneTone::kActive};
}

// A state lasts from the cycle that shows it to the next one.
StateLane laneOf(const FaultRecord& record, std::string name,
                 const std::function<Word(const CycleRecord&)>& word) {
  StateLane lane{std::move(name), {}};
  const auto& cycles = record.recorder.cycles();
  const double period = record.config().cycleSeconds();
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const Word now = word(cycles[i]);
    const double t = record.seconds(cycles[i].time_ns);
    const bool goes_on = !lane.stretches.empty() && lane.stretches.back().word == now.text;
    if (!lane.stretches.empty()) lane.stretches.back().end_s = t;
    if (!goes_on) lane.stretches.push_back({t, t, now.text, now.tone});
  }
  if (!lane.stretches.empty()) lane.stretches.back().end_s += period;
  return lane;
}

}  // namespace

PlotGroup faultLanes(const FaultRecord& record) {
  PlotGroup group;
  group.title = "What the bench did, and what every drive said";
  group.caption =
      "A drive's state is that of its statusword. \"PDOs missing\": a cycle in which not all of "
      "its "
      "data came; nothing is drawn of it below.";
  group.lanes.push_back(laneOf(record, "bench", benchWord));
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    group.lanes.push_back(laneOf(record, record.config().drives[i].name,
                                 [i](const CycleRecord& r) { return driveWord(r, i); }));
  }
  group.lanes.push_back(laneOf(record, "IMU", imuWord));
  return group;
}

}  // namespace ballbot
