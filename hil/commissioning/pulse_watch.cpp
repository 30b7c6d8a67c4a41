#include "hil/commissioning/pulse_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace ballbot {

PulseWatch::PulseWatch(const BenchConfig& config, int drive) noexcept
    : drive_(static_cast<std::size_t>(drive)),
      period_(config.cycleSeconds()),
      model_(kTwoPi * config.drives[drive_].torque_frequency_Hz,
             config.drives[drive_].torque_damping_ratio, config.drives[drive_].torque_delay,
             config.cycleSeconds()) {}

void PulseWatch::add(double told, const BenchSample& s) noexcept {
  if (!has_first_) {
    has_first_ = true;
    first_ = s;
    return;
  }
  model_.advance(told);
  peak_ = std::max(peak_, std::abs(told));
  // What was there before, gravity in a resting arm for one, is not of the pulse.
  const double felt = s.joint_torque[drive_] - first_.joint_torque[drive_];
  const double bent = s.motor_angle[drive_] - s.joint_angle[drive_] -
                      (first_.motor_angle[drive_] - first_.joint_angle[drive_]);
  const double expected = model_.torque(), velocity = s.joint_velocity[drive_];
  expected_felt_ += expected * felt;
  expected_expected_ += expected * expected;
  felt_bent_ += felt * bent;
  bent_bent_ += bent * bent;
  impulse_ += period_ * felt;
  impulse_moved_ += impulse_ * velocity;
  impulse_impulse_ += impulse_ * impulse_;
  moved_moved_ += velocity * velocity;
  fastest_ = std::max(fastest_, std::abs(velocity));
  for (std::size_t j = 0; j < kDriveCount; ++j) {
    const double other = std::abs(s.joint_torque[j] - first_.joint_torque[j]);
    if (j == drive_ || other <= other_torque_) continue;
    other_torque_ = other;
    other_ = static_cast<int>(j);
  }
}

double PulseWatch::gain() const noexcept {
  return expected_expected_ > 0 ? expected_felt_ / expected_expected_ : 0;
}

double PulseWatch::stiffness() const noexcept {
  return bent_bent_ > 0 ? felt_bent_ / bent_bent_ : 0;
}

double PulseWatch::direction() const noexcept {
  const double size = std::sqrt(impulse_impulse_ * moved_moved_);
  return size > 0 ? impulse_moved_ / size : 0;
}

}  // namespace ballbot
