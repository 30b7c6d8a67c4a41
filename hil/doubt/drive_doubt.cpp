#include "hil/doubt/drive_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace ballbot {
namespace {

// Over this time a disagreement of position and velocity is forgotten [s].
constexpr double kDriftMemory = 0.5;
// How hard a joint may change its speed between two samples: what widens the gap a position may
// jump over [rad/s^2].
constexpr double kHardestAcceleration = 200;
// The model begins at a torque that it does not know.
constexpr int kSettlingCycles = 12;
// A felt torque that stays the same bit for bit while the model says it moves: cycles count from
// where the model has moved at all, and it must move this far.
constexpr double kMovingCounts = 2;
constexpr double kRepeatCounts = 8;
constexpr double kEchoCounts = 1;

bool maps(const std::vector<PdoMapping>& pdos, ObjectAddress object) {
  return std::any_of(pdos.begin(), pdos.end(),
                     [&](const PdoMapping& pdo) { return static_cast<bool>(pdo.find(object)); });
}

}  // namespace

DriveDoubt::DriveDoubt(const BenchConfig& config, int drive)
    : config_(config),
      drive_(drive),
      model_(kTwoPi * config.drives[static_cast<std::size_t>(drive)].torque_frequency_Hz,
             config.drives[static_cast<std::size_t>(drive)].torque_damping_ratio,
             config.drives[static_cast<std::size_t>(drive)].torque_delay, config.cycleSeconds()),
      has_demand_(maps(config.inputs, {0x6074, 0})),
      has_motor_(maps(config.inputs, {0x60E4, 1})) {}

void DriveDoubt::keep(const DriveSeen& seen) noexcept {
  gap_ = 0;
  last_angle_ = seen.angle;
  last_velocity_ = seen.velocity;
  has_last_ = true;
}

void DriveDoubt::rest(const DriveSeen& seen) noexcept {
  if (seen.fresh) {
    keep(seen);
    model_.restAt(seen.torque);
  } else {
    has_last_ = false;
  }
  drift_ = 0;
  told_before_ = 0;
  echo_wrong_ = spring_wrong_ = torque_wrong_ = enabled_for_ = repeats_ = 0;
}

Finding DriveDoubt::check(const DriveSeen& seen, std::int64_t sent) noexcept {
  const std::int64_t told = config_.synchronous_outputs ? told_before_ : sent;
  told_before_ = sent;
  const DriveScaling& scale = config_.drives[static_cast<std::size_t>(drive_)].scaling;
  const double told_torque = scale.torque(told);
  for (int i = 0; i < seen.elapsed; ++i) model_.advance(told_torque);
  gap_ += seen.elapsed;
  if (!seen.fresh) return {};
  enabled_for_ = seen.enabled ? enabled_for_ + seen.elapsed : 0;
  const Finding found[] = {checkContinuity(seen), checkSpring(seen), checkEcho(seen, told),
                           checkTorque(seen, told_torque)};
  for (const Finding& f : found) {
    if (f) return f;
  }
  return {};
}

// The first sample after missing ones has come further than one period's velocity says; how much
// further it may have come grows with the square of the time in between.
Finding DriveDoubt::checkContinuity(const DriveSeen& seen) noexcept {
  const double time = gap_ * config_.cycleSeconds();
  const double expected = last_angle_ + 0.5 * time * (last_velocity_ + seen.velocity);
  const double rectangle = last_angle_ + time * seen.velocity;
  const bool known = has_last_;
  keep(seen);
  if (!known) return {};
  const double jump = seen.angle - expected;
  const double most = config_.safety.position_jump + 0.5 * kHardestAcceleration * time * time;
  if (std::abs(jump) > most) return found(BenchFault::kPositionJump, jump, most);
  drift_ = (drift_ + seen.angle - rectangle) * std::max(0.0, 1 - time / kDriftMemory);
  if (std::abs(drift_) <= config_.safety.encoder_mismatch) return {};
  return found(BenchFault::kEncoderImplausible, drift_, config_.safety.encoder_mismatch);
}

Finding DriveDoubt::checkSpring(const DriveSeen& seen) noexcept {
  if (!has_motor_) return {};
  const DriveScaling& scale = config_.drives[static_cast<std::size_t>(drive_)].scaling;
  spring_mismatch_ = seen.motor_angle - seen.angle - seen.torque / scale.spring_stiffness;
  const double limit = config_.safety.spring_mismatch;
  spring_wrong_ = std::abs(spring_mismatch_) > limit ? spring_wrong_ + 1 : 0;
  if (spring_wrong_ < config_.safety.doubt_cycles) return {};
  return found(BenchFault::kSpringDisagrees, spring_mismatch_, limit);
}

// What the drive works towards, against what it was sent: exact, so one count is already too much.
// In the drives' own position loop the demand is theirs.
Finding DriveDoubt::checkEcho(const DriveSeen& seen, std::int64_t told) noexcept {
  if (!has_demand_ || config_.mode != DriveMode::kTorque || enabled_for_ < 2) return {};
  const auto wrong = static_cast<double>(seen.demand - told);
  echo_wrong_ = std::abs(wrong) > kEchoCounts ? echo_wrong_ + 1 : 0;
  if (echo_wrong_ < config_.safety.doubt_cycles) return {};
  const double unit =
      config_.drives[static_cast<std::size_t>(drive_)].scaling.torque_reference / 1000;
  return found(BenchFault::kEchoDiffers, unit * wrong, unit * kEchoCounts);
}

Finding DriveDoubt::checkTorque(const DriveSeen& seen, double told) noexcept {
  if (config_.mode != DriveMode::kTorque || enabled_for_ < kSettlingCycles) return {};
  const SafetyConfig& s = config_.safety;
  const double expected = model_.torque();
  torque_mismatch_ = seen.torque - expected;
  const double limit =
      s.torque_mismatch + s.torque_mismatch_share * std::max(std::abs(told), std::abs(expected));
  // Counts down slowly: a difference that changes its sign passes through zero.
  torque_wrong_ = std::abs(torque_mismatch_) > limit ? torque_wrong_ + 2 : torque_wrong_ - 1;
  torque_wrong_ = std::max(torque_wrong_, 0);
  if (torque_wrong_ >= 2 * s.torque_mismatch_cycles) {
    return found(BenchFault::kTorqueDiffers, torque_mismatch_, limit);
  }
  if (repeats_ == 0 || seen.torque != repeated_) {
    repeated_ = seen.torque;
    repeats_ = 1;
    repeat_low_ = repeat_high_ = expected;
    return {};
  }
  repeat_low_ = std::min(repeat_low_, expected);
  repeat_high_ = std::max(repeat_high_, expected);
  const double unit =
      config_.drives[static_cast<std::size_t>(drive_)].scaling.torque_reference / 1000;
  const double moved = repeat_high_ - repeat_low_;
  if (moved >= kMovingCounts * unit) ++repeats_;
  if (s.torque_repeats == 0 || repeats_ < s.torque_repeats || moved < kRepeatCounts * unit) {
    return {};
  }
  return found(BenchFault::kTorqueRepeats, moved, kRepeatCounts * unit);
}

}  // namespace ballbot
