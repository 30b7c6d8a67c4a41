#pragma once

#include "controller/control_law.hpp"
#include "controller/lqr.hpp"
#include "controller/set_point.hpp"

namespace ballbot {

class ConfigReader;

struct LqrLawConfig {
  SetPoint set_point;
  LqrWeights weights;
  /// Errors beyond these are cut, so that a far set-point makes the robot cruise, not fall.
  double position_error_limit = 0.5;  ///< [m]
  double yaw_error_limit = 0.8;       ///< [rad]

  /// With the arm in the robot's nominal pose.
  static LqrLawConfig defaults(const RobotParameters& robot);
  void describe(ConfigVisitor& v);
  /// @throw InputError as ConfigReader, or for an arm pose that the robot cannot hold.
  static LqrLawConfig read(ConfigReader& in, const RobotParameters& robot);
};

/// Balances at a set-point by LQR about the equilibrium of the arm pose. A plan is the gain turned
/// into the present heading, the reference it acts on, and the joint angles measured, so that PD
/// loops on the joints do not fight where the ball has rolled to.
class LqrLaw final : public ControlLaw {
 public:
  /// @throw NumericalError if the pose has no equilibrium or cannot be balanced.
  LqrLaw(const RobotParameters& robot, const LqrLawConfig& config);

  PlanReport plan(SimTime now, const StateVector& x,
                  const JointVector& joint_angle) noexcept override;
  void setCircumstances(const Circumstances& now) noexcept override;
  void activatePlan() noexcept override { active_ = planned_; }
  void sample(SimTime now, PolicySample& out) const noexcept override;
  void commanded(SimTime, SimDuration, const JointVector&) noexcept override {}

  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.config_.set_point.ball_position);
    visit(self.config_.set_point.yaw);
    visit(self.planned_);
    visit(self.active_);
  }

  /// With all wheels.
  const LqrSolution& solution() const { return solution_; }

  /// Moves the set-point in the plane, from the next plan on.
  void setGroundSetPoint(const Eigen::Vector2d& ball_position, double yaw) noexcept {
    config_.set_point.ball_position = ball_position;
    config_.set_point.yaw = yaw;
  }
  /// As sample(), of the newest plan whether it was activated or not.
  void samplePlan(SimTime now, PolicySample& out) const noexcept { sampleOf(planned_, now, out); }

 private:
  struct Plan {
    SimTime stamp{};
    PolicySample at_stamp;

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.stamp);
      visit(self.at_stamp);
    }
  };
  static void sampleOf(const Plan& plan, SimTime now, PolicySample& out) noexcept;
  Plan planFor(SimTime now, const StateVector& x, const JointVector& joint_angle) const noexcept;

  LqrLawConfig config_;
  ReducedDynamics dynamics_;
  LqrSolution solution_;
  std::array<FeedbackGain, kWheelCount> without_;  ///< gains for the robot that has lost a wheel
  WheelFlags lost_{};
  double known_payload_;  ///< [kg]
  LastingForces lasting_;
  Plan planned_, active_;
};

}  // namespace ballbot
