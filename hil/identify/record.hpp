#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// What becomes of a drive's output while a record is taken.
enum class Posture {
  kBlocked,     ///< held still
  kFree,        ///< turns its own load
  kBackDriven,  ///< a person, or the stand, turns it against the drive's torque
};
const char* toText(Posture posture) noexcept;

/// What one drive was told and what it measured while it was excited, once a bus cycle. Sample n
/// was taken at t_n; the command `sent[n]` holds from t_n to t_n+1, and `motor_torque[n]` is the
/// mean from t_n-1 to t_n. All at the joint: angles behind the gear, torques multiplied by it.
struct Record {
  std::string name;
  Posture posture = Posture::kBlocked;
  bool held_out = false;             ///< for validation: nothing is fitted to it
  double period = 0;                 ///< of the bus cycle [s]
  int repeats = 0;                   ///< samples after which the excitation repeats; 0: it does not
  std::vector<double> sent;          ///< torque command [N m]
  std::vector<double> motor_torque;  ///< from the motor's current [N m]
  std::vector<double> joint_torque;  ///< as the drive shows it [N m]
  std::vector<double> motor_angle, joint_angle;  ///< before and behind the spring [rad]

  /// Deflection of the spring, backlash included [rad]. A blocked output can give way only as the
  /// torque pushes it, so there the encoder behind the spring counts by how its readings follow the
  /// rotor's, not one by one.
  std::vector<double> deflection() const;

  int size() const { return static_cast<int>(sent.size()); }
};

/// Whether any record has a motor torque at all: a drive that shows no current leaves zeros.
bool showsCurrent(const std::vector<Record>& records);

}  // namespace ballbot
