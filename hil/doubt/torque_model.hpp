#pragma once

namespace ballbot {

/// How a drive answers a torque command, as identified: second order, unit gain at rest, with a
/// delay below one cycle. Predicts what 6077 shows at the next sample. Pure; nothing allocates.
class TorqueModel {
 public:
  /// @param natural_frequency  [rad/s], above 0
  /// @param damping_ratio      above 0
  /// @param delay              of a command; cut to one cycle [s]
  /// @param period             of a cycle [s]
  TorqueModel(double natural_frequency, double damping_ratio, double delay, double period) noexcept;

  /// The joint is at rest with this torque in its spring [N m].
  void restAt(double torque) noexcept;
  /// One cycle with this command from its beginning on [N m].
  void advance(double command) noexcept;
  /// At the end of that cycle [N m].
  double torque() const noexcept { return torque_; }

 private:
  /// Exact solution over a fixed time for a constant command.
  struct Transition {
    double xx = 1, xv = 0, vx = 0, vv = 1;
  };
  static Transition over(double time, double w, double d) noexcept;
  void apply(const Transition& t, double command) noexcept;

  Transition before_, after_;  ///< of the delay: the old command acts, then the new one
  double last_command_ = 0, torque_ = 0, rate_ = 0;
};

}  // namespace ballbot
