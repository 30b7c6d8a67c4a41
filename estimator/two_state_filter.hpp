#pragma once

#include "estimator/arm_sensing.hpp"
#include "estimator/balance_aiding.hpp"
#include "estimator/estimator.hpp"
#include "estimator/frame_order.hpp"
#include "estimator/information_filter.hpp"
#include "estimator/joint_history.hpp"
#include "estimator/pose_aiding.hpp"
#include "estimator/two_state_settings.hpp"
#include "model/omniwheel_kinematics.hpp"

namespace ballbot {

/// The estimator of the robot: a two-state implicit filter on the intervals between inertial
/// samples. Here live time and what can go wrong with it: samples that are late, missing or
/// spoiled, frames from another time, encoders at another rate. The equations are in residuals.hpp,
/// the algebra in information_update.hpp, the judgement in outlier_gate.hpp, poses from outside in
/// pose_aiding.hpp.
///
/// While held (`at_rest`) tilt and gyroscope bias are aligned, and px = py = yaw = 0 unless poses
/// from outside say where the robot stands; with the release the filter starts, and rest has no
/// meaning of its own any more.
template <int kDim>
class BasicTwoStateFilter final : public Estimator {
 public:
  BasicTwoStateFilter(const RobotParameters& robot, const TwoStateSettings& settings);

  bool update(const SensorFrame& frame, bool at_rest) noexcept override;
  StateEstimate estimate(SimTime now) const noexcept override;
  bool knowsSpin() const noexcept override { return kSpins; }
  std::optional<SelfAssessment> selfAssessment() const noexcept override;
  void setHand(double mass, bool known) noexcept override { balance_.setHand(mass, known); }
  RejectionCounts rejections() const noexcept override { return counts_; }
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.order_);
    visit(self.arm_);
    visit(self.joints_);
    visit(self.alignment_);
    visit(self.filter_);
    visit(self.accel_gate_);
    visit(self.gyro_gate_);
    visit(self.poses_);
    visit(self.balance_);
    visit(self.counts_);
    visit(self.time_);
    visit(self.yaw_);
    visit(self.released_);
    visit(self.running_);
    visit(self.imu_count_);
    visit(self.pose_count_);
    visit(self.first_imu_count_);
    visit(self.first_imu_time_);
    visit(self.imu_period_);
    visit(self.wheel_angle_);
    visit(self.wheel_angle_known_);
    if constexpr (kSpins) visit(self.spin_load_);
  }

  /// The state at its own time, the last inertial sample, with its covariance.
  SimTime stateTime() const { return time_; }
  const FilterState& state() const { return filter_.state(); }
  BasicTangentMatrix<kDim> covariance() const noexcept { return filter_.covariance(); }
  const BasicTangentMatrix<kDim>& information() const { return filter_.information(); }
  /// Chi-square of the last update, with its degrees of freedom.
  double nis() const { return filter_.nis(); }
  int nisDegrees() const { return filter_.nisDegrees(); }
  /// The floor does not hold the ball; never, where the spin is not estimated.
  bool spinning() const { return filter_.spinning(); }

 private:
  void takeImu(const SensorFrame& frame) noexcept;
  void align(const SensorFrame& frame) noexcept;
  void release(const SensorFrame& frame) noexcept;
  void leapTo(SimTime time) noexcept;
  void stepTo(SimTime time, const SensorFrame* imu) noexcept;
  void followYaw() noexcept;
  void followSpinLoad(double h, const JointVector& joint_torque) noexcept;

  static constexpr bool kSpins = kDim > kTanSpin;

  TwoStateSettings settings_;
  double gravity_;  ///< [m/s^2]
  OmniwheelKinematics wheels_;
  FrameOrder order_;
  ArmSensing arm_;
  JointHistory joints_;
  RestAlignment alignment_;
  BasicInformationFilter<kDim> filter_;
  SpikeGate accel_gate_, gyro_gate_;
  PoseAiding poses_;
  BalanceAiding balance_;
  RejectionCounts counts_;

  SimTime time_{};         ///< of the filter's state
  double yaw_ = 0;         ///< continuous, of the filter's state [rad]
  bool released_ = false;  ///< no longer held
  bool running_ = false;   ///< released, and the filter has a state to start from
  std::int64_t imu_count_ = 0, pose_count_ = 0;
  std::int64_t first_imu_count_ = 0;
  SimTime first_imu_time_{};
  SimDuration imu_period_{2'500'000};      ///< until rest has shown another
  Vector3 wheel_angle_ = Vector3::Zero();  ///< at time_ [rad]
  bool wheel_angle_known_ = false;
  double spin_load_ = 0;  ///< of the wheels on the ball about the vertical, smoothed [N m]
};
/// The ball does not spin.
using TwoStateFilter = BasicTwoStateFilter<kTangentDim>;
/// It may.
using SpinTwoStateFilter = BasicTwoStateFilter<kSpinTangentDim>;

}  // namespace ballbot
