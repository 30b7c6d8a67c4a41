#pragma once

#include "hil/bench_config.hpp"
#include "hil/doubt/torque_model.hpp"

namespace ballbot {

/// Sums over a short pulse of low torque on one drive. Pure; nothing allocates.
class PulseWatch {
 public:
  PulseWatch(const BenchConfig& config, int drive) noexcept;

  /// @param told    torque sent at the beginning of this cycle [N m]
  /// @param sample  at its end
  void add(double told, const BenchSample& sample) noexcept;

  /// Torque felt over torque expected, least squares; 0 where nothing was felt.
  double gain() const noexcept;
  /// Torque felt over the spring's deflection, least squares [N m/rad]; 0 without deflection.
  double stiffness() const noexcept;
  /// Correlation of the joint's velocity with the torque's impulse, -1 to 1.
  double direction() const noexcept;
  /// Largest velocity of the joint [rad/s].
  double fastest() const noexcept { return fastest_; }
  /// Largest torque told [N m].
  double peak() const noexcept { return peak_; }
  /// The other drive that felt most, and how much [N m].
  int other() const noexcept { return other_; }
  double otherTorque() const noexcept { return other_torque_; }

 private:
  std::size_t drive_;
  double period_;
  TorqueModel model_;
  bool has_first_ = false;
  BenchSample first_;
  double expected_felt_ = 0, expected_expected_ = 0;
  double felt_bent_ = 0, bent_bent_ = 0;
  double impulse_ = 0, impulse_moved_ = 0, impulse_impulse_ = 0, moved_moved_ = 0;
  double fastest_ = 0, peak_ = 0, other_torque_ = 0;
  int other_ = -1;
};

}  // namespace ballbot
