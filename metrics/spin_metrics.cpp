#include "metrics/spin_metrics.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {

void SpinMetrics::add(SimTime now, double spin_rate, double torque, double held) {
  if (now < from_) return;
  any_ = true;
  spin_rate_ = std::max(spin_rate_, std::abs(spin_rate));
  // A floor that holds nothing is used up by any spin.
  const double use = held > 0 ? std::abs(torque) / held : spin_rate == 0 ? 0.0 : 1.0;
  use_ = std::max(use_, use);
}

std::map<std::string, double> SpinMetrics::values() const {
  if (!any_) return {};
  return {{"largest_spin_rate_rad_per_s", spin_rate_}, {"spin_torque_use", use_}};
}

std::vector<std::string> SpinMetrics::names() {
  return {"largest_spin_rate_rad_per_s", "spin_torque_use"};
}

}  // namespace ballbot
