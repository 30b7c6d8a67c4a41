#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "controller/shaped_lqr.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {

/// What stands between the torque a controller asks for and the joint.
struct LoopDrives {
  RobotActuators actuators;  ///< friction: its viscous part
  double drive_period =
      0;  ///< tick of the torque loops, adds half of it to the current loop's lag [s]
};

/// The control loop about an equilibrium in continuous time, opened at the torques: linear
/// dynamics, drives, delay, law and shaping filters. Signs are those of negative feedback: the loop
/// closes with -1. A picture of the loop that runs, which is sampled: its margins are
/// SampledLoop's.
class TorqueLoop {
 public:
  using Wheels = Eigen::Matrix<std::complex<double>, kWheelCount, kWheelCount>;
  using Joints = Eigen::Matrix<std::complex<double>, kJointCount, kJointCount>;

  /// @param drives  none: the torque asked for acts at once
  /// @param delay   of every torque [s]
  TorqueLoop(const ShapedLqr& law, const ReducedDynamics& dynamics,
             const std::optional<LoopDrives>& drives, double delay);

  /// Opened at all six torques, at omega > 0 [rad/s].
  Joints joints(double omega) const;
  /// Opened at the wheel torques, the arm's loops closed.
  Wheels wheels(double omega) const;

  /// Largest real part of the closed loop's poles without the delay [1/s].
  double slowestPoleWithoutDelay() const;

 private:
  const ShapedLqr law_;
  double delay_;
  Eigen::MatrixXd A_, B_;  ///< from torques asked for to (x, drives)
};

/// Frequencies at which loops are looked at: from 0.05 to 500 Hz, evenly spaced on a log scale.
std::vector<double> loopFrequencies();

/// A loop in the frequency domain, in three numbers.
struct LoopShape {
  double crossover = 0;    ///< highest frequency at which a wheel loop's gain is 1 [rad/s]
  double distance = 0;     ///< smallest singular value of 1 + L at the wheels, over frequency
  double distance_at = 0;  ///< where [rad/s]
};
LoopShape shapeOf(const TorqueLoop& loop);

}  // namespace ballbot
