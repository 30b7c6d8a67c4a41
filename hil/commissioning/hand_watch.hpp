#pragma once

#include <array>

#include "hil/bench_signals.hpp"

namespace ballbot {

/// What a robot without voltage has gone through, from one rest to the next.
struct HandMotion {
  DriveArray joint{}, motor{};     ///< change of the angles, joint side [rad]
  std::array<double, 3> turned{};  ///< of the base: its angular velocity in B integrated [rad]
  std::array<double, 3> before{}, after{};  ///< specific force in B at rest, mean [m/s^2]
};

/// Watches a robot that is moved by hand: rest, motion, rest. Pure; nothing allocates.
class HandWatch {
 public:
  /// @param period         of add() [s]
  /// @param rest_velocity  what joints and base stay below while they rest [rad/s]
  HandWatch(double period, double rest_velocity) noexcept;

  /// From here on a new motion is looked for; first the robot has to rest.
  void begin() noexcept;
  void add(const BenchSample& sample) noexcept;

  /// It rested before, so that motion is counted from there.
  bool started() const noexcept { return started_; }
  /// It has rested for half a second, since begin() or since it moved.
  bool atRest() const noexcept { return rested_ >= rest_cycles_; }
  bool hasMoved() const noexcept { return moved_; }
  /// Angles and forces at rest are means over it. Valid once started() and atRest().
  const HandMotion& motion() const noexcept { return motion_; }
  /// At rest: angles of the joints, and the gyroscope's bias as it was before the motion [rad/s].
  const DriveArray& jointAngle() const noexcept { return mean_.joint_angle; }
  const std::array<double, 3>& gyroBias() const noexcept { return bias_; }

 private:
  bool isStill(const BenchSample& sample) const noexcept;
  void average(const BenchSample& sample) noexcept;
  void conclude() noexcept;

  double period_, rest_velocity_;
  int rest_cycles_;
  int rested_ = 0;
  bool started_ = false, moved_ = false;
  BenchSample mean_;   ///< over the present rest
  BenchSample first_;  ///< over the rest before the motion
  std::array<double, 3> bias_{}, turned_{};
  HandMotion motion_;
};

}  // namespace ballbot
