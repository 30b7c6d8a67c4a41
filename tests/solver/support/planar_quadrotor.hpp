#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "solver/relaxed_barrier.hpp"
#include "tests/solver/support/discretised_problem.hpp"

namespace ballbot {

/// A quadrotor in a vertical plane; state (x [m], z [m], tilt [rad], rates), inputs the thrusts of
/// the left and of the right rotor [N]. Quadratic cost of the pose and of the thrusts' distance
/// from hovering; relaxed barriers keep each thrust within 0 and largest_thrust and the quadrotor
/// out of a disc.
struct PlanarQuadrotor {
  static constexpr int kNX = 6, kNU = 2;
  using X = Eigen::Matrix<double, 6, 1>;
  using U = Eigen::Vector2d;

  double mass = 0.5, inertia = 0.004, arm = 0.17, gravity = 9.81;  // [kg], [kg m^2], [m], [m/s^2]
  double largest_thrust = 5;                                       // of each rotor [N]
  RelaxedBarrier thrust{0.05, 0.1}, obstacle{0.5, 0.05};
  Eigen::Vector2d center{0, -0.2};
  double radius = 0.8;  // [m]; 0 is no obstacle
  X goal = (X() << 2, 0, 0, 0, 0, 0).finished();
  X weight = (X() << 0.5, 0.5, 0.5, 0.05, 0.05, 0.05).finished();
  X final_weight = (X() << 400, 400, 100, 40, 40, 10).finished();
  double thrust_weight = 0.1;

  U hover() const { return U::Constant(0.5 * mass * gravity); }

  X flow(const X& x, const U& u) const {
    const double acceleration = (u[0] + u[1]) / mass;
    X dx;
    dx << x.tail<3>(), -acceleration * std::sin(x[2]), acceleration * std::cos(x[2]) - gravity,
        arm * (u[1] - u[0]) / inertia;
    return dx;
  }
  void linearize(const X& x, const U& u, Eigen::Matrix<double, 6, 6>& fx,
                 Eigen::Matrix<double, 6, 2>& fu) const {
    const double s = std::sin(x[2]), c = std::cos(x[2]);
    fx.setZero();
    fx.topRightCorner<3, 3>().setIdentity();
    fx(3, 2) = -(u[0] + u[1]) / mass * c;
    fx(4, 2) = -(u[0] + u[1]) / mass * s;
    fu.setZero();
    fu.row(3).setConstant(-s / mass);
    fu.row(4).setConstant(c / mass);
    fu.row(5) << -arm / inertia, arm / inertia;
  }
  /// Distance from the disc, near it [m].
  double clearance(const X& x) const {
    return ((x.head<2>() - center).squaredNorm() - radius * radius) / (2 * radius);
  }
  void addCost(const X& x, const U& u, double dt, ScalarCost& cost) const {
    cost.add(0.5 * dt * weight.dot((x - goal).cwiseAbs2()));
    cost.add(0.5 * dt * thrust_weight * (u - hover()).squaredNorm());
    for (int i = 0; i < 2; ++i) {
      cost.add(dt * (thrust.value(u[i]) + thrust.value(largest_thrust - u[i])));
      cost.require(u[i]);
      cost.require(largest_thrust - u[i]);
    }
    if (radius > 0) cost.add(dt * obstacle.value(clearance(x)));
  }
  /// Gauss-Newton in the clearance: its own curvature would make the Hessian indefinite.
  void expandCost(const X& x, const U& u, double dt, LqStage<6, 2>& lq) const {
    lq.Q().diagonal() += dt * weight;
    lq.q() += dt * weight.cwiseProduct(x - goal);
    for (int i = 0; i < 2; ++i) {
      const auto low = thrust.derivatives(u[i]), high = thrust.derivatives(largest_thrust - u[i]);
      lq.R()(i, i) += dt * (thrust_weight + low.second + high.second);
      lq.r()[i] += dt * (thrust_weight * (u[i] - hover()[i]) + low.first - high.first);
    }
    if (radius > 0) {
      const auto d = obstacle.derivatives(clearance(x));
      const Eigen::Vector2d gradient = (x.head<2>() - center) / radius;
      lq.Q().topLeftCorner<2, 2>() += dt * d.second * gradient * gradient.transpose();
      lq.q().head<2>() += dt * d.first * gradient;
    }
  }
  void addFinalCost(const X& x, ScalarCost& cost) const {
    cost.add(0.5 * final_weight.dot((x - goal).cwiseAbs2()));
  }
  void expandFinalCost(const X& x, ValueFunction<6>& value) const {
    value.set(final_weight.asDiagonal(), final_weight.cwiseProduct(x - goal), 0);
  }

  /// The same motion another way: Newton's law with the thrust as a turned vector, in many small
  /// leaps of velocity Verlet.
  X moved(X x, const U& u, double duration) const {
    const int steps = 200;
    const double h = duration / steps;
    const double turn = arm * (u[1] - u[0]) / inertia;
    const auto acceleration = [&](double tilt) {
      return Eigen::Vector2d(Eigen::Rotation2Dd(tilt) * Eigen::Vector2d(0, u.sum() / mass) -
                             Eigen::Vector2d(0, gravity));
    };
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d before = acceleration(x[2]);
      x.head<2>() += h * x.segment<2>(3) + 0.5 * h * h * before;
      x[2] += h * x[5] + 0.5 * h * h * turn;
      x[5] += h * turn;
      x.segment<2>(3) += 0.5 * h * (before + acceleration(x[2]));
    }
    return x;
  }
};

}  // namespace ballbot
