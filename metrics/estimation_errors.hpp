#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "estimator/estimator.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Truth less estimate at one instant.
struct EstimationError {
  Eigen::Vector2d tilt_W = Eigen::Vector2d::Zero();      ///< rotation about x and y of W [rad]
  Eigen::Vector2d velocity_W = Eigen::Vector2d::Zero();  ///< [m/s]
  Eigen::Vector2d position_W = Eigen::Vector2d::Zero();  ///< [m]
  double yaw = 0;                                        ///< in [-pi, pi] [rad]
};

/// How far an estimate is from the truth, accumulated over a run from the release on.
class EstimationErrors {
 public:
  explicit EstimationErrors(SimTime release) : release_(release) {}

  /// Both of the same instant and in the same frame (HomeFrame); instants in order. What is before
  /// the release does not count.
  void add(const TruthFrame& truth, const StateVector& estimate);
  /// Of the last instant that counted.
  const EstimationError& last() const { return error_; }
  bool started() const { return started_; }

  /// The filter's own judgement of itself against the truth, at an instant that is its state's own
  /// (an IMU tick without delay). Call after add() of the same instant. NEES is that of tilt and
  /// velocity, four numbers, so 4 is expected; the angular rate, a mean over the interval, and the
  /// biases, of which no truth is recorded, are left out.
  void addConsistency(const SelfAssessment& assessment);

  /// Every number under its documented name (docs/metrics.md). A metric without data is absent.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  SimTime release_;
  bool started_ = false;
  SimTime last_{};
  EstimationError error_;
  Eigen::Vector2d last_position_ = Eigen::Vector2d::Zero();
  double observed_s_ = 0, tilt2_integral_ = 0, velocity2_integral_ = 0;
  double largest_tilt_ = 0, distance_ = 0;
  double nees_sum_ = 0, nis_sum_ = 0, nis_degrees_sum_ = 0;
  int consistency_samples_ = 0;
};

}  // namespace ballbot
