#pragma once

#include "estimator/arm_sensing.hpp"
#include "estimator/estimator.hpp"
#include "estimator/filter_state.hpp"
#include "estimator/frame_order.hpp"
#include "estimator/joint_history.hpp"
#include "estimator/rest_alignment.hpp"
#include "estimator/shared_settings.hpp"
#include "estimator/wheel_odometry.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

struct ComplementarySettings : SharedSettings {
  /// Below this odometry decides about the velocity, above it the accelerometer [rad/s].
  double velocity_bandwidth_rad_per_s = 15;
  /// Below this gravity decides about the tilt, above it the gyroscope [rad/s].
  double tilt_bandwidth_rad_per_s = 0.3;
  /// How slowly the gyroscope bias follows [s].
  double gyro_bias_time_constant_s = 60;
  /// A larger difference between odometry and predicted velocity counts as this much [m/s].
  double velocity_innovation_limit_m_per_s = 0.2;
  /// Spin that odometry finds, averaged over 0.1 s, above which it is the ball's and no bias of the
  /// gyroscope [rad/s].
  double spin_limit_rad_per_s = 0.05;

  void describe(ConfigVisitor& v);
  /// Without those that every estimator has.
  void describeOwn(ConfigVisitor& v);
  /// @throw InputError
  static ComplementarySettings read(ConfigReader& in);
};

/// Fixed-gain observer on measurements alone: the gyroscope turns the attitude, the accelerometer
/// drives the velocity, and the difference between that velocity and wheel odometry corrects
/// velocity, tilt and gyroscope bias. Comparing velocities rather than accelerations takes the
/// base's own acceleration into account without differentiating encoders. The spin that odometry
/// finds on a ball that the floor holds corrects the bias about the vertical; where it is more than
/// a bias can be, the ball spins and corrects nothing. Position is integrated odometry. The robot
/// is at px = py = yaw = 0 while it is held; gives no sigma.
class ComplementaryObserver final : public Estimator {
 public:
  ComplementaryObserver(const RobotParameters& robot, const ComplementarySettings& settings);

  /// A frame that is older than the last one, far ahead of it, or not finite, is passed over. Rest
  /// after the release has no meaning of its own.
  bool update(const SensorFrame& frame, bool at_rest) noexcept override;
  StateEstimate estimate(SimTime now) const noexcept override;
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.order_);
    visit(self.arm_);
    visit(self.joints_);
    visit(self.alignment_);
    visit(self.imu_count_);
    visit(self.released_);
    visit(self.time_);
    visit(self.x_);
    visit(self.yaw_);
    visit(self.joint_angle_);
    visit(self.spin_);
  }

 private:
  void takeImu(const SensorFrame& frame) noexcept;
  void align(const SensorFrame& frame) noexcept;
  void step(const SensorFrame& frame) noexcept;

  // Configuration.
  ComplementarySettings settings_;
  OmniwheelKinematics kinematics_;
  double ball_radius_;  ///< [m]
  double gravity_;      ///< [m/s^2]
  Vector3 p_BI_B_;      ///< IMU from the ball centre [m]

  // State.
  FrameOrder order_;
  ArmSensing arm_;
  JointHistory joints_;
  RestAlignment alignment_;
  std::int64_t imu_count_ = 0;
  bool released_ = false;
  SimTime time_{};                                 ///< of what follows: the last IMU sample
  FilterState x_;                                  ///< its accelerometer bias stays zero
  double yaw_ = 0;                                 ///< continuous [rad]
  JointVector joint_angle_ = JointVector::Zero();  ///< at time_
  double spin_ = 0;                                ///< that odometry finds, averaged [rad/s]
};

}  // namespace ballbot
