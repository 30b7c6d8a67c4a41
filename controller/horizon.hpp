#pragma once

#include <vector>

namespace ballbot {

class ConfigReader;

/// Knots of the horizon, in seconds from its start: fine steps first, then coarse ones, because
/// what is far away will be planned again.
struct Horizon {
  double fine_length = 0;     ///< [s]
  double fine_step = 0.01;    ///< [s]
  double length = 1;          ///< of the whole horizon [s]
  double coarse_step = 0.02;  ///< [s]

  std::vector<double> knots() const;

  /// Keys: length_s, step_ms, and optionally fine_length_s with fine_step_ms. Lengths must be whole
  /// multiples of their steps.
  static Horizon read(ConfigReader& in);
};

}  // namespace ballbot
