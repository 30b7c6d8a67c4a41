#include "controller/linear_law.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

/// Of states, angles and torques alike: far above what the solver's noise of 1e-11 of the cost
/// leaves in a plan, far below where the robot bends.
constexpr double kStep = 1e-4;
/// Long enough for a filter to forget all but the torque it is told of.
constexpr SimDuration kForever = std::chrono::hours(1);
constexpr int kPlansToRest = 40;

using Output = Eigen::Matrix<double, kTrackerOutputDim, 1>;

class Differentiator {
 public:
  Differentiator(ControlLaw& law, const TrackerConfig& tracker, const LawRest& rest, SimTime at)
      : law_(law), tracker_(tracker), at_(at) {
    start_ << rest.x, rest.torque.head<kFilterDim>(), rest.joint_angle;
    now_ << rest.x, rest.torque.head<kFilterDim>(), rest.joint_angle, JointVector::Zero();
    for (int i = 0; i < kPlansToRest; ++i) plan(start_);
    settled_ = law_.saveState();
  }

  std::vector<LinearCommand> at(const std::vector<SimDuration>& ages) {
    std::vector<LinearCommand> out(ages.size());
    for (int i = 0; i < kPlanStartDim; ++i) {
      PlanStartVector up = start_, down = start_;
      up[i] += kStep;
      down[i] -= kStep;
      const std::vector<Output> above = ofStart(up, ages), below = ofStart(down, ages);
      for (std::size_t k = 0; k < ages.size(); ++k) {
        out[k].by_start.col(i) = (above[k] - below[k]) / (2 * kStep);
      }
    }
    law_.restoreState(settled_);
    law_.activatePlan();
    for (int i = 0; i < kTrackerInputDim; ++i) {
      TrackerInputVector up = now_, down = now_;
      up[i] += kStep;
      down[i] -= kStep;
      for (std::size_t k = 0; k < ages.size(); ++k) {
        out[k].by_now.col(i) = (command(up, ages[k]) - command(down, ages[k])) / (2 * kStep);
      }
    }
    return out;
  }

 private:
  std::vector<Output> ofStart(const PlanStartVector& start, const std::vector<SimDuration>& ages) {
    law_.restoreState(settled_);
    plan(start);
    law_.activatePlan();
    std::vector<Output> out;
    for (const SimDuration age : ages) out.push_back(command(now_, age));
    return out;
  }

  void setFilter(const Vector3& xf) {
    JointVector torque = JointVector::Zero();
    torque.head<kFilterDim>() = xf;
    law_.commanded(at_, kForever, torque);
  }

  void plan(const PlanStartVector& start) {
    setFilter(start.segment<kFilterDim>(kStartFilter));
    const PlanReport report = law_.plan(at_, start.segment<kStateDim>(kStartState),
                                        start.segment<kJointCount>(kStartJoints));
    if (report.accepted) return;
    throw NumericalError(
        fmt::format("the control law refuses to plan from rest ({}), so its loop cannot be "
                    "analysed",
                    planStatusName(report.status)));
  }

  Output command(const TrackerInputVector& now, SimDuration age) {
    setFilter(now.segment<kFilterDim>(kNowFilter));
    PolicySample policy;
    law_.sample(at_ + age, policy);
    ActuatorCommand c;
    const TrackStatus status =
        tracker_.step(policy, now.segment<kStateDim>(kNowState),
                      now.segment<kJointCount>(kNowJoints), now.segment<kJointCount>(kNowRates), c);
    if (status != TrackStatus::kOk) {
      throw NumericalError(fmt::format(
          "the command at rest, {:g} ms after its plan, is {}: there is no loop to be analysed",
          1e3 * toSeconds(age),
          status == TrackStatus::kNotFinite ? "not finite" : "cut by the tracker's torque limit"));
    }
    Output out;
    out << c.torque, c.stiffness.cwiseProduct(c.position) + c.damping.cwiseProduct(c.velocity);
    return out;
  }

  ControlLaw& law_;
  PdTracker tracker_;
  SimTime at_;
  PlanStartVector start_;
  TrackerInputVector now_;
  StateBlob settled_;
};

}  // namespace

std::vector<LinearCommand> linearizeLaw(ControlLaw& law, const TrackerConfig& tracker,
                                        const LawRest& rest, SimTime at,
                                        const std::vector<SimDuration>& ages) {
  return Differentiator(law, tracker, rest, at).at(ages);
}

}  // namespace ballbot
