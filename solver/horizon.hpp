#pragma once

#include <vector>

namespace ballbot {

/// Knots of the horizon, in seconds from its start: fine steps first, then coarse ones, because
/// what is far away will be planned again. Lengths are whole multiples of their steps.
struct Horizon {
  double fine_length = 0;     ///< [s]
  double fine_step = 0.01;    ///< [s]
  double length = 1;          ///< of the whole horizon [s]
  double coarse_step = 0.02;  ///< [s]

  std::vector<double> knots() const;
};

}  // namespace ballbot
