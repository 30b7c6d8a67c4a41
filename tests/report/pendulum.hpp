#pragma once

#include <array>
#include <cmath>

namespace ballbot {

/// A ball that carries an upper body, in one vertical plane. All of it in SI units.
struct Pendulum {
  static constexpr double kGravity = 9.81, kBallRadius = 0.125;
  static constexpr double kBodyMass = 22.71, kBodyHeight = 0.289, kBodyInertia = 1.1;
  static constexpr double kRollingMass = 4.12;  ///< ball, its rolling inertia and the wheels'

  double x = 0, v = 0, lean = 0, rate = 0;

  /// Horizontal forces on the upper body, each at its height above the ball's centre.
  struct Force {
    double newton = 0, height = 0;
  };

  /// Torque between base and ball, forward positive. The gains put the poles at -1.4 +- 0.9i, -5.2
  /// and -6 rad/s.
  double balancingTorque() const { return 6.263 * x + 8.579 * v + 54.92 * lean + 9.889 * rate; }

  /// Total energy: kinetic, and potential of the lean (zero upright).
  double energy() const {
    const double coupling = kBodyMass * kBodyHeight;
    const double inertia = kBodyInertia + coupling * kBodyHeight;
    return 0.5 * (kRollingMass + kBodyMass) * v * v + coupling * std::cos(lean) * v * rate +
           0.5 * inertia * rate * rate + coupling * kGravity * (std::cos(lean) - 1);
  }

  /// One step of the classical Runge-Kutta method with torque and forces held.
  void step(double h, double torque, const std::array<Force, 2>& forces) {
    const std::array<double, 4> s = {x, v, lean, rate};
    const auto k1 = derivative(s, torque, forces);
    const auto k2 = derivative(moved(s, k1, h / 2), torque, forces);
    const auto k3 = derivative(moved(s, k2, h / 2), torque, forces);
    const auto k4 = derivative(moved(s, k3, h), torque, forces);
    std::array<double, 4> out = s;
    for (int i = 0; i < 4; ++i) out[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    x = out[0], v = out[1], lean = out[2], rate = out[3];
  }

 private:
  static std::array<double, 4> moved(std::array<double, 4> s, const std::array<double, 4>& k,
                                     double h) {
    for (int i = 0; i < 4; ++i) s[i] += h * k[i];
    return s;
  }

  static std::array<double, 4> derivative(const std::array<double, 4>& s, double torque,
                                          const std::array<Force, 2>& forces) {
    const double sine = std::sin(s[2]), cosine = std::cos(s[2]);
    const double coupling = kBodyMass * kBodyHeight;
    const double m11 = kRollingMass + kBodyMass, m12 = coupling * cosine;
    const double m22 = kBodyInertia + coupling * kBodyHeight;
    double f1 = torque / kBallRadius + coupling * sine * s[3] * s[3];
    double f2 = -torque + coupling * kGravity * sine;
    for (const Force& force : forces) {
      f1 += force.newton;
      f2 += force.newton * force.height * cosine;
    }
    const double det = m11 * m22 - m12 * m12;
    return {s[1], (m22 * f1 - m12 * f2) / det, s[3], (m11 * f2 - m12 * f1) / det};
  }
};

}  // namespace ballbot
