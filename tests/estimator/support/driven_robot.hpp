#pragma once

#include "controller/lqr.hpp"
#include "core/random.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/signals.hpp"

namespace ballbot::test {

/// A robot that obeys its equations of motion: the reduced model, balanced on its true state by an
/// LQR whose set point sways by some centimetres. Sensors at 400 Hz with biases, white noise and
/// encoder steps. What drawn motions cannot offer: it falls as gravity makes it fall.
class DrivenRobot {
 public:
  static constexpr double kPeriod_s = 2.5e-3;
  static constexpr double kRest_s = 0.5;  ///< held, before it is let go

  explicit DrivenRobot(std::uint64_t seed = 1);

  /// One period of the IMU.
  /// @param force_W  on the end-effector [N]
  void advance(const Vector3& force_W = Vector3::Zero());

  const SensorFrame& frame() const { return frame_; }
  const StateVector& x() const { return x_; }
  const RobotParameters& robot() const { return dynamics_.robot(); }
  double time_s() const { return kPeriod_s * static_cast<double>(tick_); }
  bool atRest() const { return time_s() <= kRest_s; }

  Vector3 accel_bias = Vector3::Zero();  ///< [m/s^2]
  double sway_m = 0.03;

 private:
  Vector3 imuVelocity() const;
  JointVector torque() const;

  ReducedDynamics dynamics_;
  LqrSolution lqr_;
  RandomStream gyro_, accel_;
  std::int64_t tick_ = 0;
  StateVector x_;
  JointVector joint_angle_ = JointVector::Zero();
  SensorFrame frame_;
};

}  // namespace ballbot::test
