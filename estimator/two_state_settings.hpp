#pragma once

#include "estimator/balance_aiding.hpp"
#include "estimator/external_pose.hpp"
#include "estimator/initial_state.hpp"
#include "estimator/outlier_gate.hpp"
#include "estimator/residuals.hpp"
#include "estimator/shared_settings.hpp"
#include "estimator/spin_gate.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

struct TwoStateSettings : SharedSettings {
  FilterNoise noise;
  InitialUncertainty initial;
  GateSettings gate;
  ExternalPoseSettings pose;
  BalanceSettings balance;
  SpinSettings spin;
  bool use_external_pose = false;
  int iterations = 2;
  /// An inertial sample may arrive so late; after that its interval is gone through without it.
  SimDuration imu_wait{6'000'000};
  /// Laid on pitch and roll at the release, unknown to the covariance: a fault to study [rad].
  Eigen::Vector2d initial_tilt_error = Eigen::Vector2d::Zero();

  void describe(ConfigVisitor& v);
  /// Without those that every estimator has.
  void describeOwn(ConfigVisitor& v);
  /// Every key has a default. @throw InputError with file:line:column
  static TwoStateSettings read(ConfigReader& in);
};

}  // namespace ballbot
