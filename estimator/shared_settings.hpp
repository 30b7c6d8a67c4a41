#pragma once

namespace ballbot {

class ConfigVisitor;

/// What every estimator is set by.
struct SharedSettings {
  double arm_rate_time_constant_s = 0.002;
  /// IMU samples at rest before the estimate calls itself aligned.
  int alignment_samples = 40;

  void describe(ConfigVisitor& v);
};

}  // namespace ballbot
