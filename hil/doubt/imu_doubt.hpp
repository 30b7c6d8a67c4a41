#pragma once

#include <array>

#include "hil/bench_config.hpp"
#include "hil/doubt/finding.hpp"

namespace ballbot {

/// Doubts the IMU: values that repeat bit for bit while the counter runs, a specific force that no
/// robot on a ball feels for long, and a vertical by the accelerometer that is not the one the
/// gyroscope has turned. Pure; nothing allocates.
class ImuDoubt {
 public:
  explicit ImuDoubt(const BenchConfig& config);

  /// Nothing is checked; the next sample is the first.
  void rest() noexcept;
  /// A new sample, `dt` after the one before [s].
  /// @param accel  specific force in B [m/s^2]
  /// @param gyro   angular velocity in B [rad/s]
  /// @param up     the vertical in B that the gyroscope has carried along, unit length
  Finding check(double dt, const std::array<double, 3>& accel, const std::array<double, 3>& gyro,
                const std::array<double, 3>& up) noexcept;

 private:
  int repeats_allowed_;
  int accel_repeats_ = 0, gyro_repeats_ = 0, force_wrong_ = 0;
  bool has_last_ = false;
  std::array<double, 3> last_accel_{}, last_gyro_{}, off_{};
};

}  // namespace ballbot
