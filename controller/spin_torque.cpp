#include "controller/spin_torque.hpp"

#include <algorithm>
#include <cmath>

#include "controller/input_sizes.hpp"

namespace ballbot {

SpinTorque::SpinTorque(const RobotParameters& robot) {
  for (int i = 0; i < kWheelCount; ++i) {
    scaled_axles_.row(i) = -robot.ball.radius / robot.wheels.radius * robot.wheelAxle(i);
  }
}

SpinTorque::PerWheel SpinTorque::at(const StateVector& x) const noexcept {
  const double cy = std::cos(x[kPitch]), sy = std::sin(x[kPitch]);
  const double cx = std::cos(x[kRoll]), sx = std::sin(x[kRoll]);
  // z in B, and its derivatives; yaw does not change it.
  return {scaled_axles_ * Vector3(-sy, cy * sx, cy * cx),
          scaled_axles_ * Vector3(-cy, -sy * sx, -sy * cx),
          scaled_axles_ * Vector3(0, cy * cx, -cy * sx)};
}

Vector3 SpinTorque::within(double limit, const StateVector& x, const Vector3& tau) const noexcept {
  const Vector3 c = at(x).c;
  const double torque = c.dot(tau);
  return tau - (torque - std::clamp(torque, -limit, limit)) / c.squaredNorm() * c;
}

void SpinTorque::cut(double limit, const StateVector& x, JointVector& torque) const noexcept {
  torque.head<kWheelCount>() = within(limit, x, torque.head<kWheelCount>());
}

double spinTorqueCost(const SpinTorque& spin, const Constraints& limits, const StateVector& x,
                      const Vector3& tau, double share, double& violation) noexcept {
  const double limit = limits.spin_torque_limit, torque = spin.at(x).c.dot(tau);
  violation = std::max(violation, std::abs(torque) - limit);
  const RelaxedBarrier& barrier = limits.spin_torque;
  return share *
         (barrier.value(limit - torque) + barrier.value(limit + torque) - 2 * barrier.value(limit));
}

template <int NU>
void expandSpinTorqueCost(const SpinTorque& spin, const Constraints& limits, const StateVector& x,
                          const Vector3& tau, double share,
                          LqStage<kMpcStateDim, NU>& lq) noexcept {
  const SpinTorque::PerWheel per_wheel = spin.at(x);
  const Vector3& c = per_wheel.c;
  const double limit = limits.spin_torque_limit, torque = c.dot(tau);
  const auto above = limits.spin_torque.derivatives(limit - torque);
  const auto below = limits.spin_torque.derivatives(limit + torque);
  const double first = share * (below.first - above.first);
  const double second = share * (above.second + below.second);

  auto R = lq.R();
  auto r = lq.r();
  auto Q = lq.Q();
  auto q = lq.q();
  auto Pt = lq.Pt();
  R.template topLeftCorner<kWheelCount, kWheelCount>() += second * c * c.transpose();
  r.template head<kWheelCount>() += first * c;
  const double by_angle[2] = {per_wheel.by_pitch.dot(tau), per_wheel.by_roll.dot(tau)};
  for (int i = 0; i < 2; ++i) {
    q[kPitch + i] += first * by_angle[i];
    for (int j = 0; j < 2; ++j) Q(kPitch + i, kPitch + j) += second * by_angle[i] * by_angle[j];
    for (int w = 0; w < kWheelCount; ++w) Pt(kPitch + i, w) = second * by_angle[i] * c[w];
  }
}

#define BALLBOT_INSTANTIATE(NU)                                                      \
  template void expandSpinTorqueCost<NU>(const SpinTorque&, const Constraints&,      \
                                         const StateVector&, const Vector3&, double, \
                                         LqStage<kMpcStateDim, NU>&) noexcept;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
