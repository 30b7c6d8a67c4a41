#include "controller/arm_inverse_kinematics.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

#include "controller/whole_body_cost.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {

void ArmInverseKinematicsConfig::describe(ConfigVisitor& v) {
  v.choice(may("base",
               "from where the arm reaches: a base at rest where its tasks ask it to be, or "
               "where it is estimated, for whose motion the arm then makes up"),
           base, {{"task", Base::kTask}, {"estimated", Base::kEstimated}});
  v.number(may("gain_per_s", "rate at which an error of the end-effector's pose is worked off"),
           gain, {kTiny, 100});
  v.number(may("damping",
               "damping of the least squares; larger keeps joints slower near singular poses"),
           damping, {kTiny, 10});
  v.number(
      may("joint_rate_limit_rad_per_s", "largest speed of each arm joint; all slow down together"),
      rate_limit, {kTiny, 100});
}

ArmVector ArmInverseKinematics::rates(const StateVector& x, const Tasks& tasks) const noexcept {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Vector6 weight;
  // The orientation's cost is of sin(angle/2): w sin^2 = w/4 angle^2.
  weight << tasks.ee_position_weight, 0.25 * tasks.ee_orientation_weight;
  ArmVector wanted;
  if (weight.isZero(0)) {
    wanted = config_.gain * (tasks.arm_position - x.segment<kArmJointCount>(kArm1));
  } else {
    const ReducedDynamics::EndEffector ee = dynamics_.endEffector(x);
    const Eigen::Matrix<double, 6, kArmJointCount> J =
        dynamics_.endEffectorJacobian(x.head<kPositionDim>()).rightCols<kArmJointCount>();
    Vector6 twist;
    twist << tasks.v_WE_W + config_.gain * (tasks.p_WE - ee.p_WE),
        tasks.w_WE_W + 2 * config_.gain * orientationError(tasks.R_WE, ee.R_WE).e;
    const Eigen::Matrix<double, kArmJointCount, 6> JtW = J.transpose() * weight.asDiagonal();
    Eigen::Matrix<double, kArmJointCount, kArmJointCount> H = JtW * J;
    H.diagonal().array() += config_.damping * H.trace() / kArmJointCount;
    wanted = H.llt().solve(JtW * twist);
  }
  const double fastest = wanted.cwiseAbs().maxCoeff();
  return fastest > config_.rate_limit ? ArmVector(config_.rate_limit / fastest * wanted) : wanted;
}

ArmVector ArmInverseKinematics::withinLimits(const ArmVector& arm) const noexcept {
  ArmVector out;
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = dynamics_.robot().arm[i];
    out[i] = std::clamp(arm[i], link.lower_limit, link.upper_limit);
  }
  return out;
}

}  // namespace ballbot
