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

/// Name of a metric: share of the tracker's ticks after the release in which an LQR stood in for lack
/// of a plan.
constexpr const char* kFallbackPercent = "fallback_percent";

/// Wall-clock time of one plan() call and of its phases.
struct PlanTimes {
  std::int64_t total_ns = 0;
  PhaseTimes phases;
};

/// The whole controller of a run: estimator, balancing law and tracker, each at its own period.
/// It learns about the robot from sensor frames only.
class RobotController final : public SteppedController {
 public:
  /// Builds the three parts from the scenario, and their tasks into `calendar`.
  /// @throw InputError with file, line and column.
  RobotController(const Scenario& scenario, EventCalendar& calendar);

  void onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                 ControlOutput& out) noexcept override;
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  /// The same from a controller with another balancing law: what is known of the robot stays, and
  /// this law makes a plan at the next event, which acts at once.
  /// @throw InputError if the estimator is another kind.
  void takeOver(const StateBlob& blob);

  /// Counts over the run, for the summary: plans made, refused and made while the LQR stood in, ticks
  /// with saturated torque or a command that was not finite, and what the estimator rejected; and
  /// from the release on kFallbackPercent.
  std::map<std::string, double> counters() const;

  /// For those who hold the estimator's own judgement against the truth.
  const Estimator& estimator() const { return sensing_.estimator(); }

  /// How much of the commanded torques was planned, since the release.
  const FeedforwardShare& feedforwardShare() const { return state_.feedforward_share; }

  /// Measures the wall-clock time of each plan() call, up to `capacity` of them [ns]; a fact of the
  /// machine, never part of a result.
  void timePlans(PhaseClock wall_clock_ns, std::size_t capacity);
  const std::vector<PlanTimes>& planTimes() const { return plan_times_; }

 private:
  /// What goes on from one event to the next, but for the parts that keep their own.
  struct State {
    PolicySample policy;
    FeedforwardShare feedforward_share;
    bool plan_pending = false;
    bool has_policy = false;
    bool plan_now = false;  ///< whether or not the planner is due
    SimTime pending_since{};
    std::int64_t plans = 0, plans_refused = 0, plans_on_fallback = 0, plans_cut = 0;
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
      visit(self.ticks_saturated);
      visit(self.ticks_not_finite);
      visit(self.ticks_released);
      visit(self.ticks_on_fallback);
      visit(self.feedforward_share);
    }
  };
  /// What is saved.
  struct Whole;
  void restore(const StateBlob& blob, bool with_law);
  void plan(SimTime now, const SensorFrame& sensors, ControlOutput& out);
  void track(SimTime now, const SensorFrame& sensors, ControlOutput& out);

  SimTime release_;
  SimDuration tracker_period_, plan_latency_;
  RobotSensing sensing_;
  std::unique_ptr<ControlLaw> law_;
  std::unique_ptr<PdTracker> tracker_;
  TaskId tracker_task_, estimator_task_, planner_task_;

  State state_;

  PhaseClock wall_clock_ns_ = nullptr;
  std::vector<PlanTimes> plan_times_;
};

}  // namespace ballbot
