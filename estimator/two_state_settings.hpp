#pragma once

#include "estimator/balance_aiding.hpp"
#include "estimator/external_pose.hpp"
#include "estimator/initial_state.hpp"
#include "estimator/outlier_gate.hpp"
#include "estimator/residuals.hpp"

namespace ballbot {

class ConfigReader;

struct TwoStateSettings {
  FilterNoise noise;
  InitialUncertainty initial;
  GateSettings gate;
  ExternalPoseSettings pose;
  BalanceSettings balance;
  bool use_external_pose = false;
  int iterations = 2;
  double arm_rate_time_constant_s = 0.002;
  /// IMU samples at rest before the estimate calls itself aligned.
  int alignment_samples = 40;
  /// An inertial sample may arrive so late; after that its interval is gone through without it.
  SimDuration imu_wait{6'000'000};
  /// Laid on pitch and roll at the release, unknown to the covariance: a fault to study [rad].
  Eigen::Vector2d initial_tilt_error = Eigen::Vector2d::Zero();

  /// Every key has a default. @throw InputError with file:line:column
  static TwoStateSettings read(ConfigReader& in);
};

}  // namespace ballbot
