#include "metrics/feedforward_share.hpp"

#include <cmath>

namespace ballbot {

void FeedforwardShare::add(const JointVector& feedforward, const JointVector& feedback) noexcept {
  for (int j = 0; j < kJointCount; ++j) {
    const double planned = std::abs(feedforward[j]), whole = planned + std::abs(feedback[j]);
    if (!(whole > kLeastTorque)) continue;
    sum_[j] += 100 * planned / whole;
    count_[j] += 1;
  }
}

std::map<std::string, double> FeedforwardShare::values() const {
  std::map<std::string, double> m;
  const std::vector<std::string> all = names();
  const double wheels = count_.head<kWheelCount>().sum();
  if (wheels > 0) m[all[0]] = sum_.head<kWheelCount>().sum() / wheels;
  for (int i = 0; i < kArmJointCount; ++i) {
    const int j = kWheelCount + i;
    if (count_[j] > 0) m[all[1 + i]] = sum_[j] / count_[j];
  }
  return m;
}

std::vector<std::string> FeedforwardShare::names() {
  return {"feedforward_share_wheels_percent", "feedforward_share_arm1_percent",
          "feedforward_share_arm2_percent", "feedforward_share_arm3_percent"};
}

}  // namespace ballbot
