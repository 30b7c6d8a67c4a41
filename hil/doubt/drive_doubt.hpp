#pragma once

#include <cstdint>

#include "hil/bench_config.hpp"
#include "hil/doubt/finding.hpp"
#include "hil/doubt/torque_model.hpp"

namespace ballbot {

/// What one drive has said in a cycle, SI units, joint side.
struct DriveSeen {
  bool fresh = false;  ///< all its PDOs came; else the values are those of an earlier cycle
  int elapsed = 1;     ///< cycles since the bench looked last, those it left out included
  double angle = 0, motor_angle = 0, velocity = 0, torque = 0;
  std::int64_t demand = 0;  ///< 6074, per mille
  bool enabled = false;     ///< operation enabled, by its statusword
};

/// Doubts one drive: everything it says against everything else it says and against what it was
/// told. Pure; check() once per cycle while torque is on, rest() otherwise.
class DriveDoubt {
 public:
  /// @param config  must outlive this
  DriveDoubt(const BenchConfig& config, int drive);

  /// No torque: nothing is checked, but positions are kept in sight.
  void rest(const DriveSeen& seen) noexcept;
  /// @param sent  torque sent after the cycle before, per mille
  Finding check(const DriveSeen& seen, std::int64_t sent) noexcept;

  /// Torque felt that the model does not explain, and what the spring does not; of the last cycle.
  double torqueMismatch() const noexcept { return torque_mismatch_; }
  double springMismatch() const noexcept { return spring_mismatch_; }

 private:
  Finding checkContinuity(const DriveSeen& seen) noexcept;
  Finding checkSpring(const DriveSeen& seen) noexcept;
  Finding checkEcho(const DriveSeen& seen, std::int64_t told) noexcept;
  Finding checkTorque(const DriveSeen& seen, double told) noexcept;
  void keep(const DriveSeen& seen) noexcept;
  Finding found(BenchFault fault, double value, double limit) const noexcept {
    return {fault, drive_, value, limit};
  }

  const BenchConfig& config_;
  const int drive_;
  TorqueModel model_;
  bool has_demand_ = false, has_motor_ = false;
  // Continuity.
  bool has_last_ = false;
  int gap_ = 0;  ///< cycles since the sample below
  double last_angle_ = 0, last_velocity_ = 0, drift_ = 0;
  // Told and felt.
  std::int64_t told_before_ =
      0;  ///< the one before the last: acts now where outputs are synchronous
  int echo_wrong_ = 0, spring_wrong_ = 0, torque_wrong_ = 0, enabled_for_ = 0;
  double torque_mismatch_ = 0, spring_mismatch_ = 0;
  double repeated_ = 0, repeat_low_ = 0, repeat_high_ = 0;
  int repeats_ = 0;
};

}  // namespace ballbot
