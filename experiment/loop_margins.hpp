#pragma once

#include "experiment/sampled_loop.hpp"

namespace ballbot {

/// How far a loop is from instability: what it can take before a disturbance grows.
struct SampledMargins {
  bool stable = false;
  double growth_rate = 0;  ///< of what dies last, or grows [1/s]; negative: it dies
  // Only of a stable loop; infinite, or 0 for the lower gain, where none was found.
  double delay_margin = 0;        ///< of all six torques [s]
  double wheel_delay_margin = 0;  ///< of the wheels' torques alone [s]
  double wheel_gain_low = 1;      ///< factors on the wheels' torques between which it is stable
  double wheel_gain_high = 1;
};

/// Searched for in steps of a fifth up to a second of delay and to factors of 1/1000 and 1000, then
/// by bisection: delays to the tick, and within it where the growth rate crosses zero.
/// @throw NumericalError as spectralRadius.
SampledMargins marginsOf(const SampledLoop& loop);

}  // namespace ballbot
