#include "hil/identify/record.hpp"

#include <algorithm>
#include <cstddef>

namespace ballbot {
namespace {

double meanOf(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v;
  return x.empty() ? 0 : sum / static_cast<double>(x.size());
}

}  // namespace

const char* toText(Posture posture) noexcept {
  switch (posture) {
    case Posture::kBlocked:
      return "blocked";
    case Posture::kFree:
      return "free";
    case Posture::kBackDriven:
      return "back-driven";
  }
  return "";
}

std::vector<double> Record::deflection() const {
  std::vector<double> out = motor_angle;
  if (posture != Posture::kBlocked) {
    for (std::size_t n = 0; n < out.size(); ++n) out[n] -= joint_angle[n];
    return out;
  }
  const double motor = meanOf(motor_angle), joint = meanOf(joint_angle);
  double together = 0, alone = 0;
  for (std::size_t n = 0; n < out.size(); ++n) {
    together += (motor_angle[n] - motor) * (joint_angle[n] - joint);
    alone += (motor_angle[n] - motor) * (motor_angle[n] - motor);
  }
  const double give = alone > 0 ? together / alone : 0;
  for (double& x : out) x = x - joint - give * (x - motor);
  return out;
}

bool showsCurrent(const std::vector<Record>& records) {
  return std::any_of(records.begin(), records.end(), [](const Record& r) {
    return std::any_of(r.motor_torque.begin(), r.motor_torque.end(),
                       [](double t) { return t != 0; });
  });
}

}  // namespace ballbot
