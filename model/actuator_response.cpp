#include "model/actuator_response.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kHighestHz = 1e5;  // no drive's torque loop gets there

}  // namespace

std::complex<double> ActuatorResponse::at(double omega, double one_over_inertia) const {
  const std::complex<double> s(0, omega);
  const double Kp = p_.torqueGainP(), Kd = p_.torqueGainD(), k = p_.spring_stiffness;
  const std::complex<double> lag =
      std::exp(-s * half_tick_) / (1.0 + s / (kTwoPi * p_.current_loop_bandwidth));
  const std::complex<double> spring = k + p_.spring_damping * s;
  // A load turns with the spring's torque: theta_l = tau_s / (J_l s^2).
  const double J = p_.reflectedInertia(), B = p_.viscous_friction;
  const std::complex<double> rotor = (J * s * s + B * s) + (J + B / s) * spring * one_over_inertia;
  return spring * lag * (1 + Kp) / (rotor + spring + lag * k * (Kp + Kd * s));
}

double ActuatorResponse::bandwidth() const {
  const double level = std::sqrt(0.5);
  double low = kTwoPi * kHighestHz;
  while (low > 1e-3 && std::abs(blocked(low)) < level) low /= 1.1;
  double high = 1.1 * low;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::abs(blocked(middle)) < level ? high : low) = middle;
  }
  return low;
}

JointVector freeInertia(const ReducedDynamics& dynamics, const PositionVector& q) {
  const SelectionMatrix S = dynamics.selectionMatrix(q);
  const Eigen::Matrix<double, kJointCount, kJointCount> mobility =
      S * dynamics.massMatrix(q).ldlt().solve(S.transpose());
  return mobility.diagonal().cwiseInverse();
}

}  // namespace ballbot
