#pragma once

#include <vector>

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// Knots of the horizon, in seconds from its start: fine steps first, then coarse ones, because
/// what is far away will be planned again.
struct Horizon {
  double fine_length = 0;     ///< [s]
  double fine_step = 0.01;    ///< [s]
  double length = 1;          ///< of the whole horizon [s]
  double coarse_step = 0.02;  ///< [s]

  std::vector<double> knots() const;

  void describe(ConfigVisitor& v);
  /// Lengths must be whole multiples of their steps.
  /// @param in  where they were read, for the error's words
  /// @throw InputError
  void requireWholeSteps(const ConfigReader& in) const;
};

}  // namespace ballbot
