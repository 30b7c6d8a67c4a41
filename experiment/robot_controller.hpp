#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "controller/control_law.hpp"
#include "controller/floor_hold.hpp"
#include "controller/lost_wheels.hpp"
#include "controller/pd_tracker.hpp"
#include "controller/push_belief.hpp"
#include "cosim/schedule.hpp"
#include "cosim/stepped_controller.hpp"
#include "estimator/refused_wheels.hpp"
#include "experiment/beside_estimate.hpp"
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
  const AddedSignals& added(AddedTo frame) const override { return added_[frame]; }
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  /// @throw InputError if the estimator is another kind.
  void takeOver(const StateBlob& blob) override;

  /// Plans made, refused and made while the LQR stood in, ticks with saturated torque or a command
  /// that was not finite, what the estimator rejected, how much of the commanded torques was
  /// planned since the release, and from there on kFallbackPercent.
  std::map<std::string, double> metrics() const override;
  std::vector<std::string> metricNames() const override;
  void setWallClock(PhaseClock now_ns) override;

 private:
  /// What goes on from one event to the next, but for the parts that keep their own.
  struct State {
    State(const FloorHold& floor_at_first, const LostWheels& wheels_at_first,
          const PushEstimate& push_at_first, const DeadDrives& drives_at_first)
        : floor(floor_at_first),
          wheels(wheels_at_first),
          push(push_at_first),
          drives(drives_at_first) {}

    PolicySample policy;
    FloorHold floor;
    RefusedWheels refused_wheels;
    LostWheels wheels;
    PushEstimate push;
    DeadDrives drives;
    WheelFlags slipping{};      ///< or so the estimator says
    std::int64_t rejected = 0;  ///< by the estimator so far
    FeedforwardShare feedforward_share;
    bool plan_pending = false;
    bool has_policy = false;
    bool plan_now = false;  ///< whether or not the planner is due
    SimTime pending_since{};
    std::int64_t plans = 0, plans_refused = 0, plans_on_fallback = 0, plans_cut = 0;
    std::int64_t plans_begun_anew = 0;
    std::int64_t ticks_saturated = 0, ticks_not_finite = 0;
    std::int64_t ticks_released = 0, ticks_on_fallback = 0;  ///< the second is part of the first

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.policy);
      visit(self.plan_pending);
      visit(self.has_policy);
      visit(self.plan_now);
      visit(self.pending_since);
      visit(self.plans);
      visit(self.plans_refused);
      visit(self.plans_on_fallback);
      visit(self.plans_cut);
      visit(self.plans_begun_anew);
      visit(self.ticks_saturated);
      visit(self.ticks_not_finite);
      visit(self.ticks_released);
      visit(self.ticks_on_fallback);
      visit(self.feedforward_share);
      visit(self.floor);
      visit(self.refused_wheels);
      visit(self.wheels);
      visit(self.push);
      visit(self.drives);
      visit(self.slipping);
      visit(self.rejected);
    }
  };
  /// What is saved.
  struct Whole;
  void restore(const StateBlob& blob, bool with_law);
  void followWheels(SimTime now, const SensorFrame& sensors) noexcept;
  void followPush(SimTime now) noexcept;
  /// What is known, to the law.
  void tellLaw() noexcept;
  void estimate(SimTime now, const SensorFrame& sensors, ControlOutput& out);
  void plan(SimTime now, const SensorFrame& sensors, ControlOutput& out);
  void track(SimTime now, const SensorFrame& sensors, ControlOutput& out);

  SimTime release_;
  SimDuration tracker_period_, plan_latency_;
  RobotSensing sensing_;
  std::unique_ptr<ControlLaw> law_;
  std::unique_ptr<PdTracker> tracker_;
  SpinTorque spin_torque_;
  double command_share_;  ///< of what the floor is counted on to hold
  std::vector<BesideSignal> beside_estimate_;
  TaskId tracker_task_, estimator_task_, planner_task_;

  PerAddedTo<AddedSignals> added_;
  State state_;

  PhaseClock wall_clock_ns_ = nullptr;
};

}  // namespace ballbot
