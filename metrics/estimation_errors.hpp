#pragma once

#include <map>
#include <string>

#include "core/time.hpp"
#include "estimator/estimator.hpp"
#include "estimator/two_state_filter.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// How far an estimate is from the truth, accumulated over a run from the release on.
///
/// Without an external pose an estimator cannot know where in the world it was released: its
/// px = py = yaw = 0 is there. So the truth is seen from the true pose at the first instant given;
/// with `absolute` it is taken as it is.
class EstimationErrors {
 public:
  explicit EstimationErrors(SimTime release, bool absolute = false)
      : release_(release), absolute_(absolute) {}

  /// Both of the same instant; instants in order. What is before the release does not count.
  void add(const TruthFrame& truth, const StateEstimate& estimate);

  /// The filter's own judgement of itself against the truth, at an instant that is its state's own
  /// (an IMU tick without delay). Call after add() of the same instant. NEES is that of tilt and
  /// velocity, four numbers, so 4 is expected; the angular rate, a mean over the interval, and the
  /// biases, of which no truth is recorded, are left out.
  void addConsistency(const TwoStateFilter& filter);

  /// Every number under its documented name (docs/metrics.md). A metric without data is absent.
  std::map<std::string, double> values() const;

 private:
  SimTime release_;
  bool absolute_;
  bool started_ = false;
  SimTime last_{};
  Eigen::Vector2d home_W_ = Eigen::Vector2d::Zero(), last_position_ = Eigen::Vector2d::Zero();
  double home_yaw_ = 0;
  double observed_s_ = 0, tilt2_integral_ = 0, velocity2_integral_ = 0;
  double largest_tilt_ = 0, yaw_error_ = 0, position_error_ = 0, distance_ = 0;
  Eigen::Vector2d tilt_error_W_ = Eigen::Vector2d::Zero();      ///< of the last instant [rad]
  Eigen::Vector2d velocity_error_W_ = Eigen::Vector2d::Zero();  ///< likewise [m/s]
  double nees_sum_ = 0, nis_sum_ = 0, nis_degrees_sum_ = 0;
  int consistency_samples_ = 0;
};

}  // namespace ballbot
