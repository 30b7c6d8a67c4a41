#pragma once

#include <cstdint>

namespace ballbot {

/// Between a drive's counts and SI units at its joint. Vendors deviate from CiA 402 here, so every
/// factor is configuration:
///
///   joint angle    = sign * 2 pi / encoder_counts * 6064 - offset
///   joint velocity = sign * velocity_unit * 606C
///   torque         = sign * torque_reference / 1000 * 6077 (or 6071, 60B2)
///   motor torque   = sign * motor_torque_reference / 1000 * 6078
struct DriveScaling {
  double torque_reference = 1;  ///< torque of 1000 per mille: rated torque 6076 [N m]
  /// Torque behind the gear at the motor's rated current 6075; 0: the rated torque [N m].
  double motor_torque_reference = 0;
  double encoder_counts = 1;        ///< per turn of the joint (608F:01 / 608F:02 for 6064)
  double motor_encoder_counts = 1;  ///< per turn of the joint, of 60E4:01
  double velocity_unit = 1;         ///< of 606C [rad/s]
  double sign = 1;                  ///< +1 or -1
  double offset = 0;                ///< [rad]
  double spring_stiffness = 0;      ///< gives the motor's side where 60E4 is not mapped [N m/rad]

  double angle(std::int64_t counts) const noexcept;
  double motorAngle(std::int64_t counts) const noexcept;
  double velocity(std::int64_t counts) const noexcept;
  double torque(std::int64_t per_mille) const noexcept;
  double motorTorque(std::int64_t per_mille) const noexcept;
  /// To the nearest count, within what 16 or 32 bits hold.
  std::int64_t torqueCounts(double torque) const noexcept;
  std::int64_t angleCounts(double angle) const noexcept;
  std::int64_t velocityCounts(double velocity) const noexcept;
};

}  // namespace ballbot
