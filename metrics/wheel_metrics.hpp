#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// How the wheels held on to the ball, where the plant knows their contacts.
class WheelMetrics {
 public:
  /// @param from  times before do not count
  /// @param friction  coefficient between wheels and ball
  WheelMetrics(SimTime from, double friction) : from_(from), friction_(friction) {}

  /// All true, by wheel; at times that follow each other. @param normal  force [N], @param traction
  /// force [N], @param slip  velocity [m/s]
  void add(SimTime now, const Vector3& normal, const Vector3& traction, const Vector3& slip);

  /// largest_traction_use: of a wheel's traction over what friction gives at its normal force of
  /// the time, normal forces under a newton apart; above 1 where wheels cannot slip.
  /// least_wheel_normal_force_N; largest_wheel_slip_m_per_s; wheel_slip_s: how long any wheel
  /// slipped faster than kSlips. Absent without known contacts.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

  /// Beyond creep [m/s].
  static constexpr double kSlips = 0.02;

 private:
  SimTime from_, last_{};
  double friction_;
  bool any_ = false;
  double use_ = 0, normal_ = 0, slip_ = 0, slipped_s_ = 0;
};

}  // namespace ballbot
