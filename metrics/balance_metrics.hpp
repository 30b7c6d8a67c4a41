#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Tilt beyond which the robot counts as fallen. Balance is lost for good well before: the wheels'
/// traction holds a lean of about 20 degrees.
constexpr double kFallTiltDeg = 45;

/// Angle between the base's z axis and the vertical [rad].
double tiltAngle(const StateVector& x);

/// How well the robot balanced, accumulated from the true state at every communication step, so
/// that the numbers do not depend on what was recorded. Times before `release` do not count.
class BalanceMetrics {
 public:
  explicit BalanceMetrics(SimTime release) : release_(release) {}

  void add(const TruthFrame& truth, const ActuatorCommand& command);

  bool fell() const { return fell_; }

  /// Every number under its documented name (docs/metrics.md), e.g. "largest_tilt_deg". NaN-free:
  /// a metric without data is absent.
  std::map<std::string, double> values() const;
  /// All names that values() can have.
  static std::vector<std::string> names();

 private:
  SimTime release_;
  bool seen_ = false, fell_ = false, released_ = false;
  SimTime fall_time_{}, last_time_{};
  double largest_tilt_ = 0, largest_excursion_ = 0;
  double excursion2_integral_ = 0, tilt2_integral_ = 0, observed_s_ = 0;
  double largest_wheel_torque_ = 0, largest_arm_torque_ = 0;
  double torque_error2_integral_ = 0, arm_torque_error2_integral_ = 0;
  Eigen::Vector2d home_ = Eigen::Vector2d::Zero();
  TruthFrame last_;
};

}  // namespace ballbot
