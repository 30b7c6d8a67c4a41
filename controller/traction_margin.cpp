#include "controller/traction_margin.hpp"

#include <algorithm>

#include "controller/input_sizes.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/wheel_loads.hpp"

namespace ballbot {
namespace {

/// Of a state at rest, with its torques.
TractionMargin::Z coordinatesOf(const StateVector& x, const JointVector& tau) {
  TractionMargin::Z z;
  z << x.segment<TractionMargin::kAngles>(kPitch), tau;
  return z;
}

}  // namespace

TractionMargin::TractionMargin(const RobotParameters& robot, const Constraints& constraints)
    : limited_(robot.wheels.friction < kUnlimited && constraints.traction_weight > 0) {
  by_acceleration_.setZero();
  by_force_.setZero();
  if (!limited_) return;
  const WheelLoadModel loads(robot);
  const ReducedDynamics dynamics(robot);
  const double radius = robot.wheels.radius;
  const double lever = constraints.traction_share * robot.wheels.friction * radius;
  const auto marginOf = [&](const WheelLoads& load) {
    Rows rows;
    rows << lever * load.normal - radius * load.traction,
        lever * load.normal + radius * load.traction;
    return rows;
  };
  const auto acceleration = [&](const StateVector& x, const JointVector& tau) {
    return dynamics.acceleration(x.head<kPositionDim>(), x.tail<kVelocityDim>(), tau,
                                 Vector3::Zero());
  };
  const auto marginAt = [&](const Z& z) {
    StateVector x = StateVector::Zero();
    x.segment<kAngles>(kPitch) = z.head<kAngles>();
    const JointVector tau = z.tail<kJointCount>();
    return marginOf(loads.at(x, acceleration(x, tau), tau.head<kWheelCount>(), Vector3::Zero()));
  };
  const Equilibrium rest = findEquilibrium(dynamics, robot.nominal_arm);
  at_rest_ = coordinatesOf(rest.x, rest.tau);
  margin_at_rest_ = marginAt(at_rest_);
  constexpr double h = 1e-5;
  for (int i = 0; i < kZ; ++i) {
    by_z_.col(i) =
        (marginAt(at_rest_ + h * Z::Unit(i)) - marginAt(at_rest_ - h * Z::Unit(i))) / (2 * h);
  }
  // Exactly linear in these.
  const auto change = [&](const VelocityVector& dnu, const Vector3& force_W) -> Rows {
    return marginOf(loads.at(rest.x, dnu, rest.tau.head<kWheelCount>(), force_W)) - margin_at_rest_;
  };
  for (int i = 0; i < kVelocityDim; ++i) {
    by_acceleration_.col(i) = change(VelocityVector::Unit(i), Vector3::Zero());
  }
  for (int i = 0; i < 2; ++i) by_force_.col(i) = change(VelocityVector::Zero(), Vector3::Unit(i));
}

TractionMargin::Rows TractionMargin::ofPush(const Push& push) const noexcept {
  if (!push.acts) return Rows::Zero();
  return by_acceleration_ * push.acceleration + by_force_ * push.force;
}

TractionMargin::Rows TractionMargin::at(const StateVector& x,
                                        const JointVector& tau) const noexcept {
  return margin_at_rest_ + by_z_ * (coordinatesOf(x, tau) - at_rest_);
}

double tractionCost(const TractionMargin::Rows& margin, double weight, double& violation) noexcept {
  double sum = 0;
  for (const double h : margin) {
    violation = std::max(violation, -h);
    const double lack = std::min(h, 0.0);
    sum += lack * lack;
  }
  return 0.5 * weight * sum;
}

template <int NU>
void expandTractionCost(const TractionMargin& model, const TractionMargin::Rows& margin,
                        double weight, bool keeps_tilt, LqStage<kMpcStateDim, NU>& lq) noexcept {
  constexpr int n = TractionMargin::kAngles;
  auto Q = lq.Q();
  auto q = lq.q();
  auto R = lq.R();
  auto r = lq.r();
  auto Pt = lq.Pt();
  // Of an earlier plan, or of another problem in this stage.
  Pt.template block<kArmJointCount, kJointCount>(kArm1, 0).setZero();
  Pt.template block<2, kArmJointCount>(kPitch, kWheelCount).setZero();
  if (!keeps_tilt) Pt.template block<2, kWheelCount>(kPitch, 0).setZero();
  for (int row = 0; row < TractionMargin::kRows; ++row) {
    if (margin[row] >= 0) continue;
    const TractionMargin::Z g = model.byZ().row(row);
    for (int i = 0; i < n; ++i) {
      const double w = weight * g[i];
      q[kPitch + i] += w * margin[row];
      for (int j = 0; j < n; ++j) Q(kPitch + i, kPitch + j) += w * g[j];
      for (int j = 0; j < kJointCount; ++j) Pt(kPitch + i, j) += w * g[n + j];
    }
    for (int i = 0; i < kJointCount; ++i) {
      const double w = weight * g[n + i];
      r[i] += w * margin[row];
      for (int j = 0; j < kJointCount; ++j) R(i, j) += w * g[n + j];
    }
  }
}

#define BALLBOT_INSTANTIATE(NU)                                                                    \
  template void expandTractionCost<NU>(const TractionMargin&, const TractionMargin::Rows&, double, \
                                       bool, LqStage<kMpcStateDim, NU>&) noexcept;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
