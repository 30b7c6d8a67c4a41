#include "controller/floor_hold.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

constexpr SimDuration kWindow{50'000'000}, kLongestGap{20'000'000};
/// A ball that is faster all the window spins, one that is slower all the window is held; between
/// the two nothing is learned [rad/s].
constexpr double kSpins = 0.15, kHeld = 0.06;
constexpr double kGain = 0.5;          // of one window, of what is measured while the ball spins
constexpr double kUsed = 0.6;          // of what is held: so much torque is all that plans use
constexpr double kForgetAfter_s = 10;  // a ceiling met once

}  // namespace

FloorHold::FloorHold(const RobotParameters& robot, const FloorBelief& settings)
    : settings_(settings),
      spin_torque_(robot),
      ball_inertia_(robot.ball.inertia),
      wheel_inertia_(robot.wheels.spin_inertia),
      held_(settings.limited ? settings.spin_torque : kUnlimited),
      ceiling_(settings.largest) {
  for (int i = 0; i < kWheelCount; ++i) axles_.row(i) = robot.wheelAxle(i);
}

void FloorHold::update(SimTime now, const StateVector& x, double spin_rate,
                       const JointVector& joint_torque,
                       const JointVector& joint_velocity) noexcept {
  if (!settings_.limited || !settings_.learned) return;
  // What was not seen, or cannot be, is no part of a balance.
  const bool seen = joint_torque.head<kWheelCount>().allFinite() &&
                    joint_velocity.head<kWheelCount>().allFinite() && x.allFinite() &&
                    std::isfinite(spin_rate);
  if (!seen || (window_.open && (now < window_.last || now - window_.last > kLongestGap))) {
    window_ = {};
    if (!seen) return;
  }
  const Vector3 per_wheel = spin_torque_.at(x).c;
  const Vector3 wheel_spin =
      joint_velocity.head<kWheelCount>() + axles_ * x.segment<3>(kPositionDim + kOmegaX);
  // c has -rho D R^T z in it, which is what the wheels' momentum needs as well.
  const double momentum = ball_inertia_ * spin_rate + wheel_inertia_ * per_wheel.dot(wheel_spin);
  const double torque = per_wheel.dot(joint_torque.head<kWheelCount>());
  if (!window_.open) {
    window_ = {true, now, now, momentum, 0, spin_rate, spin_rate};
    return;
  }
  window_.impulse += torque * toSeconds(now - window_.last);
  window_.last = now;
  window_.slowest = std::min(window_.slowest, spin_rate);
  window_.fastest = std::max(window_.fastest, spin_rate);
  if (now - window_.begin < kWindow) return;
  const double duration = toSeconds(now - window_.begin);
  const double wheels = window_.impulse / duration;
  learn(wheels, wheels - (momentum - window_.momentum) / duration, duration);
  window_ = {true, now, now, momentum, 0, spin_rate, spin_rate};
}

void FloorHold::learn(double wheels, double floor, double duration) noexcept {
  const auto within = [this](double torque) {
    return std::clamp(torque, settings_.least, settings_.largest);
  };
  const bool spins = window_.slowest > kSpins || window_.fastest < -kSpins;
  if (spins) {
    const double against = window_.slowest > 0 ? floor : -floor;
    held_ += kGain * (within(against) - held_);
    ceiling_ = held_;
    return;
  }
  if (std::max(std::abs(window_.slowest), std::abs(window_.fastest)) > kHeld) return;
  ceiling_ = std::min(settings_.largest, ceiling_ * std::exp(duration / kForgetAfter_s));
  if (std::abs(floor) > held_) {
    held_ = within(std::abs(floor));
  } else if (std::abs(wheels) > kUsed * held_ && held_ < ceiling_) {
    held_ = std::min(ceiling_, held_ + settings_.raised * duration);
  }
}

}  // namespace ballbot
