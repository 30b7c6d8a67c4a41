#pragma once

#include <cstdint>

#include "core/random.hpp"
#include "model/signals.hpp"
#include "tests/estimator/support/smooth_motion.hpp"

namespace ballbot::test {

/// MTi-1 class figures at 400 Hz.
struct SensorNoise {
  double gyro_sigma = 2.4e-3;      ///< per sample [rad/s]
  double accel_sigma = 0.024;      ///< per sample [m/s^2]
  double gyro_bias_sigma = 3e-3;   ///< turn-on [rad/s]
  double accel_bias_sigma = 0.03;  ///< turn-on [m/s^2]
  double gyro_bias_walk = 2e-5;    ///< [rad/s per sqrt(s)]
  double accel_bias_walk = 3e-4;   ///< [m/s^2 per sqrt(s)]
  /// White noise on each wheel increment of one IMU interval, what the filter assumes [rad].
  double wheel_increment_sigma = 0;
  /// Step of the encoders, what they really do; 0: none [rad].
  double encoder_step = 0;
};

/// No noise, no bias, no quantisation.
SensorNoise noNoise();
/// White wheel increments of 0.1 rad/s, so that the filter's assumptions hold exactly.
SensorNoise whiteNoise();
/// Encoders of 0.025 degrees, as real ones are.
SensorNoise quantisedNoise();

/// What is true at the end of an IMU interval.
struct Truth {
  double t_s = 0;
  MotionSample motion;
  Vector3 mean_w_WB_B = Vector3::Zero();  ///< over the interval [rad/s]
  double mean_spin = 0;                   ///< of the ball, over the interval [rad/s]
  Vector3 accel_bias = Vector3::Zero();   ///< [m/s^2]
  Vector3 gyro_bias = Vector3::Zero();    ///< [rad/s]
};

/// Plays a motion as sensor frames at the IMU's ticks, with exact interval means and seeded noise.
class SimulatedSensors {
 public:
  static constexpr std::int64_t kImuPeriodNs = 2'500'000;

  SimulatedSensors(const MotionScript& script, const RobotParameters& robot,
                   const SensorNoise& noise, std::uint64_t seed);

  /// Moves on by one IMU period.
  void advance();

  const SensorFrame& frame() const { return frame_; }
  const Truth& truth() const { return truth_; }
  bool atRest() const { return truth_.t_s <= script_.rest_s; }

 private:
  Vector3 twist(double spin, const Matrix3& R_WB) const;

  MotionScript script_;
  RobotParameters robot_;
  SensorNoise noise_;
  RandomStream gyro_, accel_, gyro_bias_, accel_bias_, wheel_;
  std::int64_t tick_ = 0;
  Vector3 wheel_angle_ = Vector3::Zero();
  Truth truth_;
  SensorFrame frame_;
};

}  // namespace ballbot::test
