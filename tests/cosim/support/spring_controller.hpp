#pragma once

#include <cstdint>
#include <vector>

#include "cosim/stepped_controller.hpp"

namespace ballbot::testing_support {

/// Tracks a slow "plan" with joint PD: a tracker task at every tick, a planner task that keeps a
/// state of its own, so that order, rates and checkpoints show in the commands.
class SpringController final : public SteppedController {
 public:
  SpringController(TaskId tracker, TaskId planner) : tracker_(tracker), planner_(planner) {}

  std::string name() const override { return "tracker"; }
  void onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                 ControlOutput& out) noexcept override;
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

  /// Commands nan from this time on.
  void commandNanFrom(SimTime t) { nan_from_ = t; }
  std::int64_t calls() const { return calls_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.target_);
    visit(self.plans_);
  }

 private:
  TaskId tracker_, planner_;
  double target_ = 0;
  std::int64_t plans_ = 0, calls_ = 0;
  SimTime nan_from_ = SimTime::max();
};

}  // namespace ballbot::testing_support
