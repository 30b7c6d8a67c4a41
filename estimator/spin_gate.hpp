#pragma once

#include "estimator/residuals.hpp"

namespace ballbot {

class ConfigVisitor;

/// How the filter takes the ball's spin about the vertical.
struct SpinSettings {
  bool enabled = true;
  /// Of a ball that the floor holds: what friction lets creep, without the wheels' torque about the
  /// vertical [rad/s] and by it [rad/s per N m]; and for how long [s].
  double creep = 0.001;
  double creep_per_torque = 0.05;
  double creep_time_s = 0.3;
  /// Of a ball that spins, what wheels and floor do to it, new in every interval [rad/s^2].
  double acceleration = 40;
  /// Common part of the wheels' residuals beyond which the ball spins: of one interval, and
  /// averaged over 20 [standard deviations of one interval].
  double jump_sigma = 4;
  double onset_sigma = 0.6;
  /// Spin, averaged over 20 intervals, below which the floor holds the ball again [rad/s].
  double sticks_below = 0.02;

  void describe(ConfigVisitor& v);
};

/// Whether the floor holds the ball or lets it spin, and what that means for the next interval.
///
/// A floor holds the ball by friction alone: it creeps, a little and for as long as the wheels'
/// torque about the vertical lasts; or that torque is too large, and within some intervals the ball
/// spins, at accelerations of tens of rad/s^2 either way. No one noise fits both. Wide enough for
/// the spin it would hide the gyroscope's bias for ever, which shows in the wheels only while the
/// ball stands. Free of allocation; for the control step.
class SpinGate {
 public:
  explicit SpinGate(const SpinSettings& settings) : settings_(settings) {}

  /// Writes into `m` how the spin goes on over its interval. @param spin at its begin [rad/s]
  void expect(double spin, IntervalMeasurement& m) noexcept;
  /// What all wheels have in common is more than was expected, and more than any wheel alone.
  /// @param common  common part of the wheels' residuals, @param off  the residuals themselves
  /// [standard deviations], @param use  which of them count
  bool jumps(double common, const Vector3& off,
             const std::array<bool, kWheelCount>& use) const noexcept;
  /// Beyond all expectation: the interval says of itself what the spin is.
  static void expectAnything(IntervalMeasurement& m) noexcept;

  /// Learns from the wheels of an interval. @param used  which of them count
  /// @param jumped  the interval was solved expecting anything
  /// @param common  otherwise: common part of the wheels' residuals [standard deviations]
  /// @param largest_wheel_mean  that of a single wheel which is the furthest off, as averaged
  void settle(const std::array<bool, kWheelCount>& used, bool jumped, double common,
              double largest_wheel_mean) noexcept;
  /// Learns from the spin that was found in it [rad/s].
  void follow(double spin) noexcept;

  bool spinning() const { return spinning_; }
  void forget() noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.spinning_);
    visit(self.jumped_);
    visit(self.common_leads_);
    visit(self.used_);
    visit(self.common_mean_);
    visit(self.spin_mean_);
    visit(self.creep_);
  }

 private:
  SpinSettings settings_;
  bool spinning_ = false;
  bool jumped_ = false;        ///< in the last interval
  bool common_leads_ = false;  ///< what wheels have in common is more than any is off alone
  std::array<bool, kWheelCount> used_{};
  double common_mean_ = 0;  ///< of `used_`, while it sticks [standard deviations]
  double spin_mean_ = 0;    ///< while it spins [rad/s]
  double creep_ = 0;        ///< one standard deviation, expected of the last interval [rad/s]
};

}  // namespace ballbot
