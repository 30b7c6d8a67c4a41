#include "controller/dead_drives.hpp"

#include <cmath>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kShareOfSpeed = 0.7;

}  // namespace

void DriveLoss::describe(ConfigVisitor& v) {
  v.number(
      may("dead_share",
          "share of the torque that is expected of a wheel's drive, with less of which it is dead"),
      share, {0, 0.9});
  v.number(may("dead_least_torque_Nm", "torque that must be expected of a drive to tell"),
           least_torque_Nm, {0.05, 1e3});
  v.duration(may("dead_after_ms", "for how long; more than it takes to see that a wheel slips"),
             after, {1, 1e3});
}

DeadDrives::DeadDrives(const DriveLoss& settings, const WheelDrives& wheels)
    : settings_(settings),
      lag_(1 / (kTwoPi * wheels.bandwidth_Hz)),
      speed_to_tell_(kShareOfSpeed * wheels.speed_limit_rad_per_s) {}

void DeadDrives::update(SimTime now, const Vector3& asked, const WheelReadings& measured,
                        const WheelFlags& slipping) noexcept {
  const double dt = toSeconds(now - last_);
  last_ = now;
  for (int i = 0; i < kWheelCount; ++i) {
    const auto wheel = static_cast<std::size_t>(i);
    const double expected = std::abs(expected_[i]), sign = expected_[i] < 0 ? -1 : 1;
    const bool tells = expected > settings_.least_torque_Nm && !slipping[wheel] &&
                       sign * measured.velocity[i] < speed_to_tell_;
    if (!tells || sign * measured.torque[i] >= settings_.share * expected) fine_until_[wheel] = now;
    if (now - fine_until_[wheel] >= settings_.after) dead_[wheel] = true;
    expected_[i] += -std::expm1(-dt / lag_) * (asked[i] - expected_[i]);
  }
}

}  // namespace ballbot
