#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/time.hpp"

namespace ballbot {

/// How the floor held the ball against a spin about the vertical, where it can spin.
class SpinMetrics {
 public:
  /// @param from  times before do not count
  explicit SpinMetrics(SimTime from) : from_(from) {}

  /// All true. @param spin_rate  of the ball [rad/s]
  /// @param torque  of the floor on it [N m], @param held  the largest that it can be [N m]
  void add(SimTime now, double spin_rate, double torque, double held);

  /// largest_spin_rate_rad_per_s, spin_torque_use: the largest share of what the floor can hold
  /// that it was asked for; next to 1 the ball spun. Absent without a ball that can spin.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  SimTime from_;
  bool any_ = false;
  double spin_rate_ = 0, use_ = 0;
};

}  // namespace ballbot
