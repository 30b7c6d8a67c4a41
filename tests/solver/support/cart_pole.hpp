#pragma once

#include <cmath>

#include "tests/solver/support/discretised_problem.hpp"

namespace ballbot {

/// A cart on a rail with a point mass on a massless rod; state (position [m], angle from upright
/// [rad], rates), input the force on the cart [N]. From the Lagrangian, with the cart's
/// acceleration a:
///
///   a = (F + m sin(th) (l om^2 - g cos(th))) / (M + m sin^2(th)),  dom/dt = (g sin(th) - a
///   cos(th)) / l
///
/// Quadratic cost: upright in the middle of the rail.
struct CartPole {
  static constexpr int kNX = 4, kNU = 1;
  using X = Eigen::Vector4d;
  using U = Eigen::Matrix<double, 1, 1>;

  double cart = 1, mass = 0.3, length = 0.5, gravity = 9.81;  // [kg], [m], [m/s^2]
  X weight = X(1, 1, 0.1, 0.1), final_weight = X(200, 500, 20, 20);
  double force_weight = 0.05;

  static X hanging() { return X(0, M_PI, 0, 0); }

  X flow(const X& x, const U& u) const {
    const double s = std::sin(x[1]), c = std::cos(x[1]);
    const double a =
        (u[0] + mass * s * (length * x[3] * x[3] - gravity * c)) / (cart + mass * s * s);
    return X(x[2], x[3], a, (gravity * s - a * c) / length);
  }
  void linearize(const X& x, const U& u, Eigen::Matrix4d& fx, X& fu) const {
    const double s = std::sin(x[1]), c = std::cos(x[1]), om = x[3];
    const double D = cart + mass * s * s, a = flow(x, u)[2];
    const double centrifugal = length * om * om - gravity * c;
    const double a_th = mass * (c * centrifugal + gravity * s * s - 2 * a * s * c) / D;
    const double a_om = 2 * mass * s * length * om / D;
    fx << 0, 0, 1, 0, 0, 0, 0, 1, 0, a_th, 0, a_om,  //
        0, ((gravity - a_th) * c + a * s) / length, 0, -a_om * c / length;
    fu << 0, 0, 1 / D, -c / (D * length);
  }
  void addCost(const X& x, const U& u, double dt, ScalarCost& cost) const {
    cost.add(0.5 * dt * (weight.dot(x.cwiseAbs2()) + force_weight * u[0] * u[0]));
  }
  void expandCost(const X& x, const U& u, double dt, LqStage<4, 1>& lq) const {
    lq.Q().diagonal() += dt * weight;
    lq.q() += dt * weight.cwiseProduct(x);
    lq.R()(0, 0) += dt * force_weight;
    lq.r()[0] += dt * force_weight * u[0];
  }
  void addFinalCost(const X& x, ScalarCost& cost) const {
    cost.add(0.5 * final_weight.dot(x.cwiseAbs2()));
  }
  void expandFinalCost(const X& x, ValueFunction<4>& value) const {
    value.set(final_weight.asDiagonal(), final_weight.cwiseProduct(x), 0);
  }

  /// The same motion another way: both equations of motion as they come out of Lagrange's
  /// formalism, solved for the accelerations together, and many small steps of the midpoint rule.
  X moved(X x, double force, double duration) const {
    const int steps = 200;
    const double h = duration / steps;
    const auto rate = [&](const X& at) {
      Eigen::Matrix2d M;
      M << cart + mass, mass * length * std::cos(at[1]), mass * length * std::cos(at[1]),
          mass * length * length;
      const Eigen::Vector2d forces(force + mass * length * at[3] * at[3] * std::sin(at[1]),
                                   mass * gravity * length * std::sin(at[1]));
      const double det = M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0);
      return X(at[2], at[3], (M(1, 1) * forces[0] - M(0, 1) * forces[1]) / det,
               (M(0, 0) * forces[1] - M(1, 0) * forces[0]) / det);
    };
    for (int i = 0; i < steps; ++i) x += h * rate(x + h / 2 * rate(x));
    return x;
  }
};

}  // namespace ballbot
