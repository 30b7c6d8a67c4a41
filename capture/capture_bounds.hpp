#pragma once

#include <functional>
#include <vector>

#include "capture/capture_study.hpp"
#include "capture/push_bound.hpp"
#include "core/config_node.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {

/// What the bound is taken with.
struct BoundRequest {
  double blind_s = 0.06;  ///< from a push's onset, for the second bound
  double tilt_limit_deg = 25;
  int per_direction = 1;  ///< so many evenly spaced angles for each of the request's
};

/// The bounds of one variant, duration and height, over all angles.
struct CaptureBound {
  std::vector<double> angle_deg;
  std::vector<double> known_N;  ///< the whole push is known at its onset
  std::vector<double> blind_N;  ///< nothing is known of it for `blind_s`
};

/// What a scenario's robot cannot go beyond: its wheels' torque (the tracker's limit where that is
/// lower), the speed of their drives where the plant has such, friction on its floor, and
/// friction of the wheels on the ball where they can slip.
BalanceLimits balanceLimits(const RunConfig& config, double tilt_limit_deg);

/// By variant, duration and height: [(variant * durations + duration) * heights + height].
/// Variants whose robots are the same are computed once.
/// @param progress  share that is done
/// @throw InputError for a scenario that cannot be read; NumericalError as largestPush
std::vector<CaptureBound> captureBounds(const CaptureRequest& request, const BoundRequest& wanted,
                                        const ConfigNode& scenario_tree,
                                        const std::function<void(double)>& progress);

}  // namespace ballbot
