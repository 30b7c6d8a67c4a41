#include "survey/leaning.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/angle.hpp"

namespace ballbot {

Lean leanSteadily(const ReducedDynamics& dynamics, const Equilibrium& rest, double angle,
                  double heading) {
  const RobotParameters& robot = dynamics.robot();
  PositionVector q = rest.x.head<kPositionDim>();
  // A positive pitch leans along x, a positive roll against y.
  q[kPitch] += angle * std::cos(heading);
  q[kRoll] -= angle * std::sin(heading);

  // Six torques and two accelerations from eight equations.
  Eigen::Matrix<double, kVelocityDim, kVelocityDim> A;
  A.leftCols<kJointCount>() = dynamics.selectionMatrix(q).transpose();
  A.rightCols<2>() = -dynamics.massMatrix(q).leftCols<2>();
  const VelocityVector solved =
      A.fullPivLu().solve(dynamics.nonlinearEffects(q, VelocityVector::Zero()));

  Lean out;
  out.angle = angle;
  const Eigen::Vector2d a = solved.tail<2>();
  out.acceleration = a.x() * std::cos(heading) + a.y() * std::sin(heading);
  out.wheel_torque = solved.head<kWheelCount>().cwiseAbs().maxCoeff();
  const double on_ball = robot.totalMass() - robot.ball.mass;
  const double normal =
      on_ball * robot.gravity / (kWheelCount * std::cos(robot.wheels.contact_zenith));
  out.wheel_friction = out.wheel_torque / robot.wheels.radius / normal;
  // Base and arm do not turn, so all of the robot has the ball's acceleration.
  out.floor_friction = a.norm() / robot.gravity;
  return out;
}

double topSpeed(const RobotParameters& robot, double wheel_rate) {
  constexpr int kDirections = 360;
  double least = kUnlimited;
  for (int i = 0; i < kDirections; ++i) {
    const double heading = kTwoPi * i / kDirections;
    // kappa of one metre per second; wheel i turns by -r / r_w d_i . kappa.
    const Vector3 kappa(-std::sin(heading) / robot.ball.radius,
                        std::cos(heading) / robot.ball.radius, 0);
    for (int k = 0; k < kWheelCount; ++k) {
      const double rate =
          robot.ball.radius / robot.wheels.radius * std::abs(robot.wheelAxle(k).dot(kappa));
      least = std::min(least, wheel_rate / std::max(rate, 1e-9));
    }
  }
  return least;
}

}  // namespace ballbot
