#include "tests/cosim/support/spring_controller.hpp"

#include <cmath>
#include <limits>

#include "core/state_visitors.hpp"

namespace ballbot::testing_support {

void SpringController::onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                                 ControlOutput& out) noexcept {
  ++calls_;
  if (due.has(planner_)) {
    target_ = 0.9 * target_ + 0.1 * std::sin(3.0 * toSeconds(now)) + 0.01 * sensors.joint_angle[0];
    ++plans_;
    out.has_plan = true;
    out.plan = {};
    out.plan.time = now;
    out.plan.cost = target_;
    out.plan.iterations = static_cast<std::int32_t>(plans_);
    out.estimate.time = now;
    out.estimate.state.head<6>() = sensors.joint_angle;
    out.estimate.sigma.setOnes();
    out.estimate.aligned = true;
    out.has_estimate = true;
  }
  if (due.has(tracker_)) {
    out.command.torque =
        5.0 * (JointVector::Constant(target_) - sensors.joint_angle) - 0.3 * sensors.joint_velocity;
    if (now >= nan_from_) out.command.torque[2] = std::numeric_limits<double>::quiet_NaN();
  }
}

StateBlob SpringController::saveState() const { return saveStateOf(*this, "spring_controller", 1); }

void SpringController::restoreState(const StateBlob& blob) {
  restoreStateOf(*this, blob, "spring_controller", 1);
}

}  // namespace ballbot::testing_support
