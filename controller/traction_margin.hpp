#pragma once

#include "controller/constraints.hpp"
#include "controller/cost_terms.hpp"
#include "controller/mpc_dimensions.hpp"
#include "controller/pushed_problem.hpp"
#include "solver/riccati.hpp"

namespace ballbot {

/// How far the wheels are from slipping on the ball, as a plan takes it: to first order about
/// standing in the nominal pose,
///
///   h = at_rest + by_z z + fading push,   z = (pitch, roll, arm | tau) less its value at rest.
///
/// Rows: for each wheel share . lever . N - lambda and share . lever . N + lambda [N m], with N the
/// normal force, lambda the torque of its traction, lever friction times the wheel's radius
/// (WheelLoadModel). Velocities change little of it and are left out, and so are forces on the
/// end-effector.
class TractionMargin {
 public:
  static constexpr int kRows = 2 * kWheelCount;
  static constexpr int kAngles = 2 + kArmJointCount;  ///< of z: x[kPitch] to x[kArm1 + 2]
  static constexpr int kZ = kAngles + kJointCount;
  using Rows = Eigen::Matrix<double, kRows, 1>;
  using Z = Eigen::Matrix<double, kZ, 1>;

  /// Unlimited where the robot's wheels are, or where `constraints` say so.
  /// @throw NumericalError if the robot cannot stand in its nominal pose.
  TractionMargin(const RobotParameters& robot, const Constraints& constraints);

  bool isLimited() const noexcept { return limited_; }
  const Eigen::Matrix<double, kRows, kZ>& byZ() const noexcept { return by_z_; }
  /// Of a push at its start.
  Rows ofPush(const Push& push) const noexcept;
  Rows at(const StateVector& x, const JointVector& tau) const noexcept;

 private:
  bool limited_;
  Z at_rest_ = Z::Zero();
  Rows margin_at_rest_ = Rows::Zero();
  Eigen::Matrix<double, kRows, kZ> by_z_ = Eigen::Matrix<double, kRows, kZ>::Zero();
  Eigen::Matrix<double, kRows, kVelocityDim> by_acceleration_;
  Eigen::Matrix<double, kRows, 2> by_force_;
};

/// Half the squares of what the margins lack, times `weight`.
double tractionCost(const TractionMargin::Rows& margin, double weight, double& violation) noexcept;

/// The expansion of that in state and inputs, in which the cross terms of z are this one's alone
/// but for those that the tilt and the wheels have (FloorLimitedProblem).
/// @param keeps_tilt  what stands in those was written for this stage
template <int NU>
void expandTractionCost(const TractionMargin& model, const TractionMargin::Rows& margin,
                        double weight, bool keeps_tilt, LqStage<kMpcStateDim, NU>& lq) noexcept;

}  // namespace ballbot
