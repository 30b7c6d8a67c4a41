#pragma once

#include <functional>

#include "estimator/two_state_filter.hpp"
#include "tests/estimator/support/simulated_sensors.hpp"

namespace ballbot::test {

/// The truth in the filter's own terms.
FilterState truthAsFilterState(const Truth& truth);

/// Settings under which the filter's assumptions about noise are exactly those of the simulation.
TwoStateSettings matchedSettings();

/// Errors of a run after the release.
struct RunErrors {
  double tilt_rms_deg = 0, tilt_max_deg = 0;
  double velocity_rms = 0, velocity_max = 0;  ///< [m/s]
  double position_end = 0;                    ///< [m]
  double yaw_end_deg = 0;
  double distance = 0;   ///< covered by the ball [m]
  double nees_mean = 0;  ///< of the whole state, expected its dimension
  double nis_mean = 0;   ///< expected 4 while all wheels and the IMU are used
};

/// @tparam kDim  kTangentDim for a filter that takes the ball's spin for zero
template <int kDim>
struct BasicFilterRun {
  double seconds = 20;
  MotionScript script = livelyMotion();
  SensorNoise noise = quantisedNoise();
  TwoStateSettings settings;
  std::uint64_t seed = 1;
  /// What the filter takes the robot for; the sensors are those of estimatorTestRobot().
  RobotParameters believed = estimatorTestRobot();
  /// Errors count from here on [s].
  double from = 0.5;
  /// Spoils a frame before the filter sees it.
  std::function<void(SensorFrame&, const Truth&)> disturb;
  /// Sees filter and truth after every interval from `from` on.
  std::function<void(const BasicTwoStateFilter<kDim>&, const Truth&)> observe;
};
using FilterRun = BasicFilterRun<kTangentDim>;
using SpinFilterRun = BasicFilterRun<kSpinTangentDim>;

/// @param counts where not null: what the filter rejected
template <int kDim>
RunErrors play(const BasicFilterRun<kDim>& run, RejectionCounts* counts = nullptr);

}  // namespace ballbot::test
