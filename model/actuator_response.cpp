#include "model/actuator_response.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr double kHighestHz = 1e5;  // no drive's torque loop gets there
constexpr double kHighestWantedHz = 500;

/// Frequency above which a gain stays below -3 dB [rad/s].
template <typename Gain>
double lastCrossing(const Gain& gain) {
  const double level = std::sqrt(0.5);
  double low = kTwoPi * kHighestHz;
  while (low > 1e-3 && gain(low) < level) low /= 1.1;
  double high = 1.1 * low;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (gain(middle) < level ? high : low) = middle;
  }
  return low;
}

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
  return lastCrossing([this](double omega) { return std::abs(blocked(omega)); });
}

double torqueBandwidthFor(ActuatorParameters p, double drive_period, double measured_bandwidth_Hz) {
  const auto reached = [&](double wanted_Hz) {
    p.torque_bandwidth = wanted_Hz;
    const ActuatorResponse response(p, drive_period);
    const double crossing = lastCrossing([&](double omega) {
      const std::complex<double> spring(p.spring_stiffness, p.spring_damping * omega);
      return std::abs(response.blocked(omega) * p.spring_stiffness / spring);
    });
    return crossing / kTwoPi >= measured_bandwidth_Hz;
  };
  // Below the spring's own frequency the loop would need a negative gain.
  const double lowest = std::sqrt(p.spring_stiffness / p.reflectedInertia()) / kTwoPi;
  double low = lowest, high = lowest;
  while (!reached(high) && high < kHighestWantedHz) {
    low = high;
    high *= 1.05;
  }
  if (high == lowest || high >= kHighestWantedHz) {
    throw NumericalError(
        fmt::format("no drive of this motor and spring has a bandwidth of {:.3g} Hz: "
                    "it can be set from {:.3g} Hz on",
                    measured_bandwidth_Hz, lowest));
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

JointVector freeInertia(const ReducedDynamics& dynamics, const PositionVector& q) {
  const SelectionMatrix S = dynamics.selectionMatrix(q);
  const Eigen::Matrix<double, kJointCount, kJointCount> mobility =
      S * dynamics.massMatrix(q).ldlt().solve(S.transpose());
  return mobility.diagonal().cwiseInverse();
}

}  // namespace ballbot
