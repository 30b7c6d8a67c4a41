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
  std::vector<std::string> out = {"feedforward_share_wheels_percent"};
  for (int i = 1; i <= kArmJointCount; ++i) {
    out.push_back("feedforward_share_arm" + std::to_string(i) + "_percent");
  }
  return out;
}

}  // namespace ballbot
