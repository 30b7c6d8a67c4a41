#pragma once

#include "estimator/rejections.hpp"
#include "estimator/residuals.hpp"

namespace ballbot {

class ConfigVisitor;

struct GateSettings {
  /// A wheel increment further off than this is refused [standard deviations].
  double wheel_gate_sigma = 5;
  /// A wheel whose residual, averaged over 20 intervals, is further off than this is suspended
  /// until that average has halved [standard deviations of one interval].
  double wheel_slip_sigma = 1.2;
  /// A jump between two inertial samples larger than this is a spike, unless the next one agrees.
  double accel_jump_m_per_s2 = 2.0;
  double gyro_jump_rad_per_s = 0.15;
  /// Chi-square (4) above which the accelerometer is left out of an update.
  double chi_square_limit = 40;
  /// Two wheels or more refused for so long: the state is at fault, not the wheels [s].
  double state_doubt_after_s = 0.05;

  void describe(ConfigVisitor& v);
};

/// A sample that jumps from the last accepted one is refused once; if the next agrees with it, or
/// jumps as far again, the jump was real. So a spike never passes, a true step costs one sample,
/// and so does the start of an acceleration too fast for the limit (an arm that swings turns the
/// base by 80 rad/s^2, 0.2 rad/s from one sample to the next).
class SpikeGate {
 public:
  explicit SpikeGate(double jump) : jump_(jump) {}
  bool accepts(const Vector3& sample) noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.started_);
    visit(self.accepted_);
    visit(self.last_);
    visit(self.before_last_);
  }

 private:
  double jump_;
  bool started_ = false;
  Vector3 accepted_ = Vector3::Zero();
  Vector3 last_ = Vector3::Zero();
  Vector3 before_last_ = Vector3::Zero();
};

/// Decides which wheels an update may use. Residuals are judged in standard deviations of what the
/// inertial sensors, the other wheels and the past say (Baarda's data snooping). Says what it
/// refused and why. Free of allocation; for the control step.
class WheelGate {
 public:
  explicit WheelGate(const GateSettings& settings) : settings_(settings) {}

  /// Wheels to begin an update with: those measured and not suspended.
  std::array<bool, kWheelCount> usable(
      const std::array<bool, kWheelCount>& measured) const noexcept;
  /// The worst of the wheels in use if it is an outlier in this solution, otherwise -1.
  /// @param off  residuals of the wheels [standard deviations of what they should be]
  int worstOutlier(const Vector3& off, const std::array<bool, kWheelCount>& use) const noexcept;
  /// Learns from the solution with which the outliers were settled, and counts.
  void settle(const Vector3& off, const IntervalMeasurement& m,
              const std::array<bool, kWheelCount>& used, RejectionCounts& counts) noexcept;
  /// Of the wheels in use, how far off the residuals of the worst are, averaged over 20 intervals
  /// [standard deviations].
  double largestMean(const std::array<bool, kWheelCount>& use) const noexcept;

  /// Whether an encoder is out because it is stuck.
  bool anyStuck() const noexcept;
  /// More than one wheel has been refused for longer than the settings allow. One faulty wheel is a
  /// faulty wheel; several at once are a state that fits nothing.
  bool doubtsState() const noexcept;
  void forget() noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.wheels_);
    visit(self.refused_s_);
  }

 private:
  struct Wheel {
    double mean = 0;  ///< of the standardised residual
    bool suspended = false;
    bool stuck = false;  ///< stood while the robot said it turned, and has not moved since
    int standing = 0;    ///< intervals without any motion so far

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.mean);
      visit(self.suspended);
      visit(self.stuck);
      visit(self.standing);
    }
  };
  GateSettings settings_;
  std::array<Wheel, kWheelCount> wheels_;
  double refused_s_ = 0;  ///< more than one wheel refused since [s]
};

}  // namespace ballbot
