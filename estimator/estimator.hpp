#pragma once

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "estimator/rejections.hpp"
#include "model/signals.hpp"
#include "model/state.hpp"

namespace ballbot {

/// What the controller knows about the robot at one time. Yaw is continuous (not wrapped).
struct StateEstimate {
  SimTime time{};
  StateVector x = StateVector::Zero();
  /// One standard deviation of (px, py, tilt about the two horizontal axes, yaw | vx, vy, w_B):
  /// for the record and for plots [m, rad, m/s, rad/s].
  Eigen::Matrix<double, 10, 1> sigma = Eigen::Matrix<double, 10, 1>::Zero();
  bool aligned = false;  ///< false until enough rest was seen to know tilt and gyro bias
};

/// From sensor frames to the whole-body state. No call but the constructor allocates or throws.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// Takes every sensor frame of the run in order, also those with nothing new for this estimator.
  /// `at_rest`: the robot is known to be held still (before its release), so tilt and biases may
  /// be taken from what the sensors say.
  virtual void update(const SensorFrame& frame, bool at_rest) noexcept = 0;

  /// The estimate brought forward to `now`, at or after the last frame's time.
  virtual StateEstimate estimate(SimTime now) const noexcept = 0;

  /// What was not believed so far, and why.
  virtual RejectionCounts rejections() const noexcept { return {}; }

  virtual StateBlob saveState() const = 0;
  virtual void restoreState(const StateBlob& blob) = 0;
};

}  // namespace ballbot
