#pragma once

#include <optional>

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "estimator/rejections.hpp"
#include "model/self_assessment.hpp"
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
  /// Of the ball about the vertical, with one standard deviation; zero where it is not estimated
  /// [rad/s].
  double spin_rate = 0, spin_rate_sigma = 0;
  bool aligned = false;  ///< false until enough rest was seen to know tilt and gyro bias
};

/// From sensor frames to the whole-body state. No call but the constructor allocates or throws.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// Takes the sensor frames of a run in order, one per period of the estimator.
  /// `at_rest`: the robot is known to be held still (before its release), so tilt and biases may
  /// be taken from what the sensors say.
  /// @return false for a frame that was passed over because of its time
  virtual bool update(const SensorFrame& frame, bool at_rest) noexcept = 0;

  /// The estimate brought forward to `now`, at or after the last frame's time; before that, as it
  /// is.
  virtual StateEstimate estimate(SimTime now) const noexcept = 0;

  /// Whether its estimates have the ball's spin.
  virtual bool knowsSpin() const noexcept { return false; }

  /// Nothing where an estimator keeps no account of its uncertainty, or has not begun to.
  virtual std::optional<SelfAssessment> selfAssessment() const noexcept { return std::nullopt; }

  /// What hangs in the hand, by whoever feels it there: mass [kg], and whether that is all of it.
  /// Until it is, an estimator that takes the tilt from the way the robot falls leaves it alone.
  virtual void setHand(double mass, bool known) noexcept { (void)mass, (void)known; }

  /// What was not believed so far, and why.
  virtual RejectionCounts rejections() const noexcept { return {}; }

  virtual StateBlob saveState() const = 0;
  virtual void restoreState(const StateBlob& blob) = 0;
};

}  // namespace ballbot
