#pragma once

#include <array>
#include <vector>

#include "core/angle.hpp"
#include "model/robot_parameters.hpp"
#include "model/state.hpp"

namespace ballbot::test {

/// amplitude * (sin(2 pi frequency t + phase) - sin(phase)), t from the release.
struct Harmonic {
  double amplitude = 0;  ///< [m] or [rad]
  double frequency_Hz = 0;
  double phase = 0;  ///< [rad]
};

/// The ball spins about the vertical at `rate`, which it takes `ramp_s` to reach and to lose.
struct SpinPulse {
  double from_s = 0, to_s = 0;  ///< begin of the one ramp and of the other
  double rate = 0;              ///< [rad/s]
  double ramp_s = 0;
};

/// Closed-form motion of ball and base: harmonics of ball position, yaw, pitch and roll, faded in
/// with three continuous derivatives after `rest_s` of standing still at px = py = yaw = 0.
struct MotionScript {
  double rest_s = 0.5;
  double fade_s = 2.0;
  Vector3 rest_yaw_pitch_roll = Vector3::Zero();  ///< attitude held all the time; motion adds to it
  /// For px, py [m], yaw, pitch, roll [rad].
  std::array<std::vector<Harmonic>, 5> harmonics;
  std::vector<SpinPulse> spins;
};

/// Everything rigid-body kinematics says about one instant.
struct MotionSample {
  Vector3 p_WK = Vector3::Zero();    ///< ball centre, z zero [m]
  Vector3 v_WK_W = Vector3::Zero();  ///< [m/s]
  Vector3 yaw_pitch_roll = Vector3::Zero();
  Matrix3 R_WB = Matrix3::Identity();
  Vector3 w_WB_B = Vector3::Zero();            ///< [rad/s]
  Vector3 specific_force_B = Vector3::Zero();  ///< at the IMU [m/s^2]
  double spin = 0;                             ///< of the ball about the vertical [rad/s]
  Vector3 wheel_rates = Vector3::Zero();       ///< rolling without slip [rad/s]
};

MotionSample sampleMotion(const MotionScript& script, const RobotParameters& robot, double t_s);

/// Means over an interval, by Gauss-Legendre quadrature of tenth order.
struct MotionMeans {
  Vector3 specific_force_B = Vector3::Zero();
  Vector3 w_WB_B = Vector3::Zero();
  double spin = 0;
  Vector3 wheel_rates = Vector3::Zero();
};
MotionMeans averageMotion(const MotionScript& script, const RobotParameters& robot, double from_s,
                          double to_s);

/// A lively walk: about 17 m in a minute, tilting up to 8 degrees, turning up to 50.
MotionScript livelyMotion();
/// Standing still with a little tilt.
MotionScript standingStill();
/// Geometry that the sensors see: ball, wheels, place of the IMU.
RobotParameters estimatorTestRobot();

}  // namespace ballbot::test
