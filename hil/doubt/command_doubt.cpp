#include "hil/doubt/command_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ballbot {
namespace {

// A controller may ask for more than the limit in a hard recovery; not for so many times as much,
// and not for so many cycles.
constexpr double kAbsurdShare = 20;
constexpr int kAbsurdCycles = 10;
constexpr double kGainTolerance = 1e-9;

bool allFinite(const DriveArray& values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool sameBits(const BenchCommand& a, const BenchCommand& b) noexcept {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Asks for no torque at all: such a command may repeat for ever.
bool isIdle(const BenchCommand& c) noexcept {
  const auto zero = [](double v) { return v == 0; };
  return std::all_of(c.torque.begin(), c.torque.end(), zero) &&
         std::all_of(c.stiffness.begin(), c.stiffness.end(), zero) &&
         std::all_of(c.damping.begin(), c.damping.end(), zero);
}

}  // namespace

void CommandDoubt::rest() noexcept {
  age_ = repeats_ = absurd_ = 0;
  has_last_ = false;
}

Finding CommandDoubt::check(const BenchCommand* command, std::int64_t number) noexcept {
  const bool fresh = command != nullptr && number != last_number_;
  if (fresh && has_last_ && number < last_number_) {
    return {BenchFault::kCommandOrder, -1, static_cast<double>(number),
            static_cast<double>(last_number_)};
  }
  age_ = fresh ? 0 : age_ + 1;
  last_number_ = fresh ? number : last_number_;
  if (age_ > config_.safety.watchdog_cycles) {
    return {BenchFault::kCommandTimeout, -1, static_cast<double>(age_),
            static_cast<double>(config_.safety.watchdog_cycles)};
  }
  if (!fresh) return {};
  repeats_ = has_last_ && sameBits(*command, last_) && !isIdle(*command) ? repeats_ + 1 : 0;
  last_ = *command;
  has_last_ = true;
  const int most = config_.safety.command_repeats;
  if (most > 0 && repeats_ >= most) {
    return {BenchFault::kCommandRepeats, -1, static_cast<double>(repeats_),
            static_cast<double>(most)};
  }
  return checkValues(*command);
}

Finding CommandDoubt::checkValues(const BenchCommand& c) noexcept {
  if (!allFinite(c.torque) || !allFinite(c.position) || !allFinite(c.velocity) ||
      !allFinite(c.stiffness) || !allFinite(c.damping)) {
    return {BenchFault::kCommandNotFinite};
  }
  bool absurd = false;
  for (int i = 0; i < kDriveCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const DriveConfig& d = config_.drives[n];
    absurd = absurd || std::abs(c.torque[n]) > kAbsurdShare * d.limits.torque;
    // In torque mode the law may stay in the command: it is evaluated by the bench, at bus rate.
    if (config_.mode == DriveMode::kPosition &&
        (std::abs(c.stiffness[n] - d.stiffness) > kGainTolerance ||
         std::abs(c.damping[n] - d.damping) > kGainTolerance)) {
      return {BenchFault::kCommandGains, i, c.stiffness[n], d.stiffness};
    }
  }
  absurd_ = absurd ? absurd_ + 1 : 0;
  if (absurd_ < kAbsurdCycles) return {};
  return {BenchFault::kCommandAbsurd, -1, static_cast<double>(absurd_), kAbsurdCycles};
}

}  // namespace ballbot
