#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "hil/identify/balance_fit.hpp"
#include "hil/identify/loop_fit.hpp"

namespace ballbot {

/// One figure of a drive.
struct Figure {
  std::string name, unit;  ///< "rotor inertia", "kg m^2"
  std::string key;         ///< in JSON
  double value = 0, sigma = 0;
  bool identified = false;  ///< else `why`
  std::string why{};
};

struct Figures {
  std::vector<Figure> list;
  Eigen::MatrixXd correlation;  ///< of those identified, in their order in the list

  /// @throw std::out_of_range
  const Figure& at(const std::string& key) const;
};

/// What both fits mean, with the covariance carried through to first order.
/// @param back_driven  whether records show the gear under loads that turn it; without them the
///                     load-dependent friction is not identified
Figures figuresOf(const BalanceFit& balance, const LoopFit& loop, double assumed_stiffness,
                  bool back_driven);

/// Of a drive that shows no motor current: bandwidth and delay of its response alone.
Figures figuresOf(const TorqueResponse& response);

}  // namespace ballbot
