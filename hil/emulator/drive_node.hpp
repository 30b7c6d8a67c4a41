#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/emulator/canopen_node.hpp"
#include "hil/emulator/test_stand.hpp"

namespace ballbot {

/// What makes one emulated drive different from another.
struct EmulatedDriveParameters {
  int node = 1;
  std::int64_t rated_torque_mNm = 20'000;     ///< 6076
  std::int64_t max_torque_per_mille = 1'500;  ///< 6072 after power-on
  std::int64_t encoder_counts = 14'400;  ///< 608F:01, of 6064, link side, per turn of the joint
  std::int64_t motor_encoder_counts = 720'000;  ///< 60E6:01, of 60E4:01, per turn of the joint
  std::int64_t rated_current_mA = 10'000;       ///< 6075
  /// What that current gives behind the gear.
  std::int64_t rated_current_torque_mNm = 20'000;
  double sign = 1;    ///< of all angles and torques against the joint's
  double offset = 0;  ///< joint angle at which 6064 is zero [rad]
  /// Real torque over what it is told and says: what a wrong torque constant does to both.
  double torque_share = 1;
  std::int64_t sdo_delay_ns = 0;  ///< of its SDO server's answers

  // In what vendors deviate.
  std::string name = "ballbot emulated drive";  ///< 1008
  std::int64_t product_code = 0xBA11;           ///< 1018:02
  /// Torque of 1000 counts of 6071, 6072, 6074, 6077 and 60B2, shown in 2031; 0: it is 6076, and
  /// there is no 2031.
  std::int64_t torque_reference_mNm = 0;
  int velocity_bits = 32;     ///< of 606C: 32 or 16
  double velocity_unit = 0;   ///< of 606C and 60B1 [rad/s]; 0: counts of 6064 per second
  bool motor_encoder = true;  ///< whether there are 60E4, 60E6 and 60EB
  /// Values that 605A, 605E and 6007 take.
  std::vector<int> quick_stop_options{0, 1, 2, 5, 6}, fault_reaction_options{0, 1, 2},
      abort_connection_options{0, 1, 2, 3};

  double torqueUnit() const;    ///< of one count [N m]
  double velocityUnit() const;  ///< of one count [rad/s]
};

/// What a drive reads of its joint.
struct DriveFeedback {
  double joint_angle = 0;     ///< behind the spring [rad]
  double motor_angle = 0;     ///< before the spring, joint side of the gear [rad]
  double joint_velocity = 0;  ///< [rad/s]
  double joint_torque = 0;    ///< from the spring's deflection [N m]
  double motor_torque = 0;    ///< mean of the last cycle, by the motor's current [N m]
};

/// What a drive does to its joint until it says otherwise; all zero without power.
struct DriveOutput {
  double torque = 0;                  ///< [N m]
  double position = 0, velocity = 0;  ///< [rad], [rad/s]
  double stiffness = 0, damping = 0;  ///< [N m/rad], [N m s/rad]
};

constexpr std::int64_t kNoStand = 0;  ///< of object 2020:01

/// An emulated servo drive (CiA 402): power state machine, cyclic synchronous torque and position
/// modes, quick stop, fault reaction, and what happens when its master falls silent.
class DriveNode final : public CanopenNode {
 public:
  explicit DriveNode(const EmulatedDriveParameters& parameters);

  void setFeedback(const DriveFeedback& feedback) { feedback_ = feedback; }
  /// @param now_ns time that has come, for the ramps of stops
  DriveOutput output(std::int64_t now_ns);
  /// It is on a test stand, whose output object 2020:01 shows and sets from now on, resets or not.
  void setStand(StandOutput output);
  /// Only on a stand.
  StandOutput standOutput() const;
  bool enabled() const { return power_ == Power::kOperationEnabled; }
  /// Whether there is power in the motor at all, ramps included.
  bool energized() const;

  // Faults on demand.
  /// An internal fault: emergency message with this code, fault reaction, fault.
  void raiseFault(std::uint16_t code, std::uint8_t register_bit);
  /// The cause is gone; what remains is to be reset.
  void clearCause() { cause_active_ = false; }
  void setWarning(bool on) { warning_ = on; }
  void sticking(bool on);
  void shiftPosition(double angle) { parameters_.offset -= angle; }
  /// As if the key switch at the drive had been turned: to switch on disabled, without a word.
  void localDisable() { power_ = Power::kSwitchOnDisabled; }
  void freezeStatusword(std::uint16_t value) { forced_status_ = value; }

 private:
  enum class Power : std::uint8_t {
    kSwitchOnDisabled,
    kReadyToSwitchOn,
    kSwitchedOn,
    kOperationEnabled,
    kQuickStopActive,
    kFaultReactionActive,
    kFault,
  };

  void addObjects(const EmulatedDriveParameters& p);
  void addOptions(const EmulatedDriveParameters& p);
  void addControl(const EmulatedDriveParameters& p);
  void addEncoders(const EmulatedDriveParameters& p);
  std::uint32_t judge(std::uint16_t index, std::uint8_t sub, std::int64_t value) override;
  void onWritten() override;
  void refresh() override;
  void onConnectionLost() override;
  void onReset() override;
  void onPowerOff() override;
  void obey(std::uint16_t controlword);
  void startStop(Power phase);
  void finishStop();
  std::uint16_t statusword() const;
  DriveOutput wanted();

  EmulatedDriveParameters parameters_;
  DriveFeedback feedback_;
  Power power_ = Power::kSwitchOnDisabled;
  std::uint16_t last_controlword_ = 0;
  bool cause_active_ = false, warning_ = false, limited_ = false, stuck_ = false;
  double stuck_angle_ = 0;
  std::uint16_t forced_status_ = 0;
  double held_torque_ = 0;  ///< when the stop began [N m]
  double last_torque_ = 0;  ///< given out last [N m]
  std::int64_t stop_started_ns_ = 0;
};

}  // namespace ballbot
