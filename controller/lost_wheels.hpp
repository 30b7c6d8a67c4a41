#pragma once

#include "controller/dead_drives.hpp"
#include "core/time.hpp"
#include "model/wheel_flags.hpp"

namespace ballbot {

class ConfigVisitor;

/// When a wheel is no longer counted on.
struct WheelLoss {
  bool counted_out = true;
  /// Refused by the estimator for so long without a break, it slips.
  SimDuration after = std::chrono::milliseconds(20);
  /// Believed for so long without a break, it grips again: without torque a wheel that slips soon
  /// turns with the ball, and would be trusted too early. Twice as long each time that trust is
  /// betrayed within a second.
  SimDuration trusted_after = std::chrono::milliseconds(100);
  DriveLoss drives;

  void describe(ConfigVisitor& v);
};

/// Which wheel has let go of the ball, or drives it no longer. At most one: where the estimator
/// refuses several it is the state that fits nothing, and one wheel alone balances nothing. Free of
/// allocation; for the control step.
class LostWheels {
 public:
  explicit LostWheels(const WheelLoss& settings) : settings_(settings) {}

  /// One frame of the estimator.
  /// @param refused  turn as the ball does not: what the estimator refuses of wheels that turn
  /// @param dead     gets no torque: lost as long as it is
  /// @return whether something changed
  bool update(SimTime now, const WheelFlags& refused, const WheelFlags& dead = {}) noexcept;

  const WheelFlags& lost() const noexcept { return lost_; }
  bool any() const noexcept { return ballbot::any(lost_); }
  std::int64_t losses() const noexcept { return losses_; }  ///< since the start

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.lost_);
    visit(self.refused_);
    visit(self.since_);
    visit(self.trusted_since_);
    visit(self.betrayals_);
    visit(self.losses_);
    visit(self.dead_);
  }

 private:
  WheelLoss settings_;
  WheelFlags lost_{}, refused_{};
  std::array<SimTime, kWheelCount> since_{};          ///< when refused_ became what it is
  std::array<SimTime, kWheelCount> trusted_since_{};  ///< after its last loss
  std::array<int, kWheelCount> betrayals_{};          ///< in a row
  std::int64_t losses_ = 0;
  bool dead_ = false;  ///< what is lost has no torque

  SimDuration trustedAfter(std::size_t wheel) const noexcept {
    return settings_.trusted_after * (1 << betrayals_[wheel]);
  }
};

}  // namespace ballbot
