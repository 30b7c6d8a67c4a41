#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "controller/control_law.hpp"
#include "controller/pd_tracker.hpp"
#include "cosim/schedule.hpp"
#include "cosim/stepped_controller.hpp"
#include "experiment/robot_sensing.hpp"
#include "experiment/scenario.hpp"
#include "metrics/feedforward_share.hpp"

namespace ballbot {

/// The whole controller of a run: estimator, balancing law and tracker, each at its own period.
/// It learns about the robot from sensor frames only.
class RobotController final : public SteppedController {
 public:
  /// Builds the three parts, and their tasks into `calendar`.
  /// @throw InputError if no law of the scenario's kind balances its robot, or for periods that are
  /// no multiples of the calendar's step.
  RobotController(const RunConfig& config, EventCalendar& calendar);

  void onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                 ControlOutput& out) noexcept override;
  const AddedSignals& addedToPlan() const override { return added_to_plan_; }
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  /// @throw InputError if the estimator is another kind.
  void takeOver(const StateBlob& blob) override;

  /// Plans made, refused and made while the LQR stood in, ticks with saturated torque or a command
  /// that was not finite, what the estimator rejected, how much of the commanded torques was planned
  /// since the release, and from there on kFallbackPercent.
  std::map<std::string, double> metrics() const override;
  std::vector<std::string> metricNames() const override;
  void setWallClock(PhaseClock now_ns) override;

 private:
  void restore(const StateBlob& blob, bool with_law);
  void plan(SimTime now, const SensorFrame& sensors, ControlOutput& out);
  void track(SimTime now, const SensorFrame& sensors, ControlOutput& out);

  SimTime release_;
  SimDuration tracker_period_, plan_latency_;
  RobotSensing sensing_;
  std::unique_ptr<ControlLaw> law_;
  std::unique_ptr<PdTracker> tracker_;
  TaskId tracker_task_, estimator_task_, planner_task_;

  PolicySample policy_;
  AddedSignals added_to_plan_;
  FeedforwardShare feedforward_share_;
  bool plan_pending_ = false;
  bool has_policy_ = false;
  bool plan_now_ = false;  ///< whether or not the planner is due
  SimTime pending_since_{};
  std::int64_t plans_ = 0, plans_refused_ = 0, plans_on_fallback_ = 0, plans_cut_ = 0;
  std::int64_t ticks_saturated_ = 0, ticks_not_finite_ = 0;
  std::int64_t ticks_released_ = 0, ticks_on_fallback_ = 0;  ///< the second is part of the first

  PhaseClock wall_clock_ns_ = nullptr;
};

}  // namespace ballbot
