#include "metrics/wheel_metrics.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {

void WheelMetrics::add(SimTime now, const Vector3& normal, const Vector3& traction,
                       const Vector3& slip) {
  if (now < from_ || normal.isZero(0)) return;  // a stand still holds it
  for (int i = 0; i < kWheelCount; ++i) {
    if (normal[i] < 1) continue;
    const double held = friction_ * normal[i];
    use_ = std::max(use_, held > 0 ? std::abs(traction[i]) / held : 0.0);
  }
  normal_ = any_ ? std::min(normal_, normal.minCoeff()) : normal.minCoeff();
  const double fastest = slip.cwiseAbs().maxCoeff();
  slip_ = std::max(slip_, fastest);
  if (any_ && fastest > kSlips) slipped_s_ += toSeconds(now - last_);
  last_ = now;
  any_ = true;
}

std::map<std::string, double> WheelMetrics::values() const {
  if (!any_) return {};
  return {{"largest_traction_use", use_},
          {"least_wheel_normal_force_N", normal_},
          {"largest_wheel_slip_m_per_s", slip_},
          {"wheel_slip_s", slipped_s_}};
}

std::vector<std::string> WheelMetrics::names() {
  return {"largest_traction_use", "least_wheel_normal_force_N", "largest_wheel_slip_m_per_s",
          "wheel_slip_s"};
}

}  // namespace ballbot
