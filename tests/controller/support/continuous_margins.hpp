#pragma once

#include "controller/torque_loop.hpp"

namespace ballbot {

/// Margins of a loop in continuous time, from its frequency response and the poles without the
/// delay: a second way to those of a loop that is sampled fast.
struct ContinuousMargins {
  bool stable = false;
  double delay_margin = 0;  ///< delay of all six torques beyond the loop's own that makes it
                            ///< unstable [s]; negative if it is; infinite if none does
  // At the wheel torques alone, the arm's loops closed; only of a stable loop.
  double wheel_delay_margin = 0;  ///< the same for delay there [s]
  double wheel_gain_low = 1;      ///< factors there between which the loop stays stable; 0 and
  double wheel_gain_high = 1;     ///< infinity where there is no limit
};

/// Stability follows from the poles without the delay and from the first delay at which a pole
/// reaches the imaginary axis: no approximation of the delay.
ContinuousMargins continuousMargins(const ShapedLqr& law, const ReducedDynamics& dynamics,
                                    const std::optional<LoopDrives>& drives, double delay);

}  // namespace ballbot
