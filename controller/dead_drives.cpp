#include "controller/dead_drives.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kShareOfSpeed = 0.7;
constexpr double kOthersShare = 0.7;
constexpr int kMostInVain = 2;

}  // namespace

void DriveLoss::describe(ConfigVisitor& v) {
  v.boolean(
      may("dead_drives_found", "whether a wheel whose drive gives no torque is left out as well"),
      found);
  v.number(may("dead_share",
               "share of the torque that is expected of a wheel's drive, with less of which it is "
               "dead, if the others give more than 0.7 of theirs"),
           share, {0, 0.4});
  v.number(may("dead_least_torque_Nm", "torque that must be expected of a drive to tell"),
           least_torque_Nm, {0.05, 1e3});
  v.duration(may("dead_after_ms", "for how long; more than it takes to see that a wheel slips"),
             after, {1, 1e3});
  v.duration(may("dead_tried_after_ms",
                 "after which a dead drive is tried again; twice as long whenever that was in "
                 "vain, four times at most"),
             tried_after, {100, 1e6});
}

DeadDrives::DeadDrives(const DriveLoss& settings, const WheelDrives& wheels)
    : settings_(settings),
      lag_(1 / (kTwoPi * wheels.bandwidth_Hz)),
      speed_to_tell_(kShareOfSpeed * wheels.speed_limit_rad_per_s) {}

void DeadDrives::follow(double dt, const WheelReadings& measured) noexcept {
  const double share = -std::expm1(-dt / toSeconds(settings_.after));
  asked_squared_ += share * (expected_.cwiseAbs2() - asked_squared_);
  arrived_ += share * (expected_.cwiseProduct(measured.torque) - arrived_);
}

bool DeadDrives::othersLive(int wheel) const noexcept {
  double asked = 0, arrived = 0;
  for (int i = 0; i < kWheelCount; ++i) {
    if (i == wheel) continue;
    asked += asked_squared_[i];
    arrived += arrived_[i];
  }
  const double least = settings_.least_torque_Nm;
  return asked > least * least && arrived > kOthersShare * asked;
}

void DeadDrives::update(SimTime now, const Vector3& asked, const WheelReadings& measured,
                        const WheelFlags& slipping) noexcept {
  if (!settings_.found) return;
  const double dt = toSeconds(now - last_);
  last_ = now;
  follow(dt, measured);
  if (any(dead_) && now >= tried_at_) {
    dead_ = {};
    fine_until_.fill(now);
  }
  const bool slips = any(slipping);
  for (int i = 0; i < kWheelCount; ++i) {
    const auto wheel = static_cast<std::size_t>(i);
    const double expected = std::abs(expected_[i]), sign = expected_[i] < 0 ? -1 : 1;
    const bool tells = expected > settings_.least_torque_Nm && !slips && !any(dead_) &&
                       sign * measured.velocity[i] < speed_to_tell_ && othersLive(i);
    if (!tells || sign * measured.torque[i] >= settings_.share * expected) fine_until_[wheel] = now;
    if (now - fine_until_[wheel] >= settings_.after) {
      in_vain_ = deaths_ > 0 && now - tried_at_ < settings_.tried_after
                     ? std::min(in_vain_ + 1, kMostInVain)
                     : 0;
      dead_[wheel] = true;
      tried_at_ = now + settings_.tried_after * (1 << in_vain_);
      ++deaths_;
    }
    expected_[i] += -std::expm1(-dt / lag_) * (asked[i] - expected_[i]);
  }
}

}  // namespace ballbot
