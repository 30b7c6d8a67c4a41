#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "hil/can_frame.hpp"
#include "hil/emulator/drive_node.hpp"
#include "hil/emulator/emulator_config.hpp"
#include "hil/emulator/imu_node.hpp"

namespace ballbot {

class Participant;
class TestStand;
struct ActuatorCommand;

/// Six emulated drives and an IMU on one or two buses, with a robot (or a test rig) behind them. No
/// socket and no clock.
///
/// Stepped: SYNC is the clock. Once a SYNC has come on every bus, time moves by one cycle: the
/// robot with the torques in force, then everybody samples, answers, and takes over synchronous
/// outputs. Until the first SYNC, and once no node is operational any more, time passes by the
/// wall while the buses are silent, so that heartbeats come: nothing then depends on when.
/// In real time the caller moves time, and a SYNC makes the nodes of its bus sample.
///
/// The robot's own time begins one cycle after a drive has reported "operation enabled" for the
/// first time, or without SYNC when one is: until then it stands where it stands, as in a stand.
class EmulatedBench {
 public:
  /// @param robot  starts at time zero; anything that takes an ActuatorCommand
  EmulatedBench(const EmulatorConfig& config, std::unique_ptr<Participant> robot);
  ~EmulatedBench();

  void powerOn();
  void onFrame(int bus, const CanFrame& frame);
  /// Real time: the time since power-on.
  void advanceTo(std::int64_t now_ns);
  /// Stepped: nothing was heard for `elapsed_ns` of wall time.
  void idle(std::int64_t elapsed_ns);
  /// What the nodes of a bus say; the caller empties it.
  std::deque<CanFrame>& outbox(int bus) { return outbox_[static_cast<std::size_t>(bus)]; }

  std::int64_t syncs() const { return syncs_; }
  /// The robot's time [s]; 0 until it begins.
  double robotSeconds() const;
  /// The robot's time runs from now on, though no drive has been enabled yet.
  void letRobotMove() { robot_runs_ = true; }
  const Participant& robot() const { return *robot_; }
  DriveNode& drive(int i) { return *drives_[static_cast<std::size_t>(i)]; }
  /// The largest torque demanded of a motor in the last cycle, ramps of stops included [N m].
  double largestTorque() const { return largest_torque_; }
  /// Largest true tilt of the robot so far [rad]; 0 for a rig.
  double largestTilt() const { return largest_tilt_; }
  bool anyEnergized() const;
  /// Whether a drive's SDO server takes its time over an answer.
  bool owesAnswer() const;
  /// Carries out a fault now.
  void inject(const FaultOrder& order);

 private:
  void syncAll();
  void sampleBus(int bus);
  void injectInto(DriveNode& drive, const FaultOrder& order);
  void passTime(std::int64_t step_ns);
  void startSyncClock();
  bool anyOperational() const;
  void tellTime();
  ActuatorCommand readOutputs();
  void moveRobot(std::int64_t step_ns);
  void readRobot();
  void collect();
  bool busIsNeeded(int bus) const;
  bool holdBackSync(int bus);

  EmulatorConfig config_;
  std::unique_ptr<Participant> robot_;
  TestStand* stand_;  ///< the robot's place, if it is one
  std::vector<std::unique_ptr<DriveNode>> drives_;
  std::unique_ptr<ImuNode> imu_;
  std::vector<std::deque<CanFrame>> outbox_;
  std::vector<int> pending_syncs_;
  std::vector<bool> frozen_;
  std::vector<bool> heard_;           ///< a frame has come over this bus
  std::vector<int> syncs_held_back_;  ///< still to be kept from the nodes of a bus
  std::int64_t syncs_ = 0, idle_syncs_ = 0, now_ns_ = 0, idle_ns_ = 0, robot_ns_ = 0;
  bool robot_runs_ = false, sync_is_clock_ = false;
  double largest_torque_ = 0;
  double runaway_[6] = {};
  double lean_ = 0, largest_tilt_ = 0;
};

}  // namespace ballbot
