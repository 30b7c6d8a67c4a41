#include "hil/drive_scaling.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kI16 = 32767, kI32 = 2147483647;

std::int64_t nearest(double value, double bound) noexcept {
  return std::isfinite(value) ? std::llround(std::clamp(value, -bound, bound)) : 0;
}

}  // namespace

double DriveScaling::angle(std::int64_t counts) const noexcept {
  return sign * (kTwoPi / encoder_counts) * static_cast<double>(counts) - offset;
}
double DriveScaling::motorAngle(std::int64_t counts) const noexcept {
  return sign * (kTwoPi / motor_encoder_counts) * static_cast<double>(counts) - offset;
}
double DriveScaling::velocity(std::int64_t counts) const noexcept {
  return sign * velocity_unit * static_cast<double>(counts);
}
double DriveScaling::torque(std::int64_t per_mille) const noexcept {
  return sign * (torque_reference / 1000) * static_cast<double>(per_mille);
}
double DriveScaling::motorTorque(std::int64_t per_mille) const noexcept {
  const double reference = motor_torque_reference > 0 ? motor_torque_reference : torque_reference;
  return sign * (reference / 1000) * static_cast<double>(per_mille);
}
std::int64_t DriveScaling::torqueCounts(double torque) const noexcept {
  return nearest(sign * torque / (torque_reference / 1000), kI16);
}
std::int64_t DriveScaling::angleCounts(double angle) const noexcept {
  return nearest(sign * (angle + offset) / (kTwoPi / encoder_counts), kI32);
}
std::int64_t DriveScaling::velocityCounts(double velocity) const noexcept {
  return nearest(sign * velocity / velocity_unit, kI32);
}

}  // namespace ballbot
