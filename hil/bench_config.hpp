#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "core/time.hpp"
#include "hil/bench_signals.hpp"
#include "hil/can_bus.hpp"
#include "hil/drive_scaling.hpp"
#include "hil/eds/data_sheet.hpp"
#include "hil/pdo_mapping.hpp"

namespace ballbot {

class ConfigVisitor;

struct BusConfig {
  std::string address;  ///< slcan:/dev/ttyACM0 or socketcan:can0
  CanBusSettings settings;

  void describe(ConfigVisitor& v);
};

/// Where the PD law of the joints is closed.
enum class DriveMode {
  kTorque,    ///< cyclic synchronous torque (10): the tracker runs at bus rate
  kPosition,  ///< cyclic synchronous position (8) with offsets: PD in the drive
};

struct DriveLimits {
  double torque = 0;                           ///< [N m]; what is sent is cut to it
  double torque_rate = 0;                      ///< [N m/s]; likewise
  double velocity = 0;                         ///< [rad/s]; beyond it the bench stops
  double position_low = 0, position_high = 0;  ///< [rad]; likewise
};

/// What a drive's vendor says of it, and where the bench file says so; may be none.
struct NamedDataSheet {
  std::shared_ptr<const DataSheet> sheet;
  std::string where;  ///< "bench.yaml:14:3"
  explicit operator bool() const noexcept { return sheet != nullptr; }
  const DataSheet* operator->() const noexcept { return sheet.get(); }
};

struct DriveConfig {
  std::string name;        ///< "wheel 1"
  std::string off_switch;  ///< what a person pulls to take its power: "STO of the wheels, S1"
  int bus = 0, node = 0;
  NamedDataSheet data_sheet;
  DriveScaling scaling;
  /// The object that says what torque 1000 counts are, in mNm: rated torque, or a vendor's own.
  ObjectAddress torque_reference_object{0x6076, 0};
  int quick_stop_option = 2;        ///< 605A
  int fault_reaction_option = 2;    ///< 605E
  int abort_connection_option = 1;  ///< 6007: 1 fault, 2 disable voltage, 3 quick stop
  DriveLimits limits;
  double stiffness = 0, damping = 0;  ///< of the drive's position loop in kPosition mode
  // Its response to a torque command, as `ballbot identify` finds it (second order).
  double torque_frequency_Hz = 40, torque_damping_ratio = 0.7071067811865476;
  double torque_delay = 0;  ///< [s]

  /// Keys that `drive_defaults` and every entry of `drives` may have.
  void describe(ConfigVisitor& v);
};

struct ImuConfig {
  int bus = 0, node = 7;
  NamedDataSheet data_sheet;
  int period_cycles = 1;              ///< from sample to sample, where it is slower than the bus
  double accel_resolution = 4.79e-3;  ///< [m/s^2] per count
  double gyro_resolution = 1.065e-3;  ///< [rad/s] per count

  void describe(ConfigVisitor& v, SimDuration cycle, double last_bus);
};

struct SafetyConfig {
  int watchdog_cycles = 20;        ///< without a new command
  int damping_cycles = 80;         ///< bounded damping, then torque off
  double damping = 0.5;            ///< [N m s/rad]
  double damping_torque = 2;       ///< its bound [N m]
  int ramp_cycles = 40;            ///< torque from zero to all of it after engaging
  double rest_velocity = 0.05;     ///< engage only below it [rad/s]
  double tilt = 0.35;              ///< [rad]
  int stale_cycles = 3;            ///< a drive's or the IMU's frames missing
  int heartbeat_cycles = 12;       ///< a heartbeat missing
  int late_cycles = 4;             ///< periods skipped in a row by the loop
  int transition_cycles = 40;      ///< for a drive to confirm a transition
  double encoder_mismatch = 0.05;  ///< position against integrated velocity [rad]
  int confirm_cycles = 4;          ///< on the way down: for a drive to say that it is off
  // Doubts: hil/doubt/, docs/hil.md#checks.
  double position_jump = 0.02;          ///< in one step, beyond what the velocity says [rad]
  double spring_mismatch = 0.004;       ///< motor angle, joint angle and torque [rad]
  double torque_mismatch = 0.4;         ///< felt against expected [N m]
  double torque_mismatch_share = 0.25;  ///< and of the torque asked for or expected
  int torque_mismatch_cycles = 6;       ///< how long
  int doubt_cycles = 3;                 ///< for what is exact: spring, torque demand
  int most_misses = 6;                  ///< cycles of the last 32 without a drive's PDOs
  int torque_repeats = 8;     ///< cycles of one torque bit for bit while it should move; 0: any
  int imu_repeats = 6;        ///< samples equal bit for bit; 0: as many as there are
  int read_back_cycles = 10;  ///< from one parameter read to the next; 0: none
  int command_repeats = 8;    ///< commands equal bit for bit; 0: as many as there are

  /// Times in the file become whole cycles, rounded up.
  void describe(ConfigVisitor& v, SimDuration cycle);

 private:
  void describeDoubts(ConfigVisitor& v);
};

struct RealtimeConfig {
  int priority = 80;               ///< SCHED_FIFO
  SimDuration collect{1'200'000};  ///< after SYNC: the drives' answers are awaited so long
  SimDuration act{1'500'000};      ///< after SYNC: the command goes out

  void describe(ConfigVisitor& v, SimDuration cycle);
};

/// What commissioning is told: hil/commissioning/.
struct CommissioningConfig {
  std::array<double, 3> arm_pose{};  ///< joint angles at the arm's marks [rad]
  double torque_share = 0.15;        ///< of each drive's torque limit

  void describe(ConfigVisitor& v);
};

/// The bench as the adapter has it: buses, drives, IMU, limits.
struct BenchConfig {
  SimDuration cycle{2'500'000};
  bool stepped = false;  ///< SYNC is the clock: no wall-clock time at all
  int master_node = 127;
  DriveMode mode = DriveMode::kTorque;
  bool synchronous_outputs = false;  ///< RPDOs act at the next SYNC instead of on reception
  int master_heartbeat_ms = 5, master_timeout_ms = 25;  ///< the drives' watch over the master
  int drive_heartbeat_ms = 10;
  int sdo_timeout_ms = 500;         ///< for one answer, in the set-up and in `hil --check`
  int boot_timeout_ms = 2000;       ///< from a reset to the boot-up message
  int output_deadline_ms = 15;      ///< RPDO event timer in the drives; 0: none
  std::vector<PdoMapping> outputs;  ///< RPDO1..
  bool shared_outputs = false;     ///< one RPDO for all drives of a bus, see hil/shared_outputs.hpp
  std::vector<PdoMapping> inputs;  ///< TPDO1..
  std::vector<BusConfig> buses;
  std::array<DriveConfig, kDriveCount> drives;
  ImuConfig imu;
  SafetyConfig safety;
  RealtimeConfig realtime;
  CommissioningConfig commissioning;
  std::string scenario_path;
  std::vector<std::string> overrides;  ///< of the scenario, "path=value"

  /// Whether all buses are CAN FD; either all are, or none.
  bool flexible() const { return !buses.empty() && buses[0].settings.flexible(); }
  double cycleSeconds() const { return toSeconds(cycle); }
  int cyclesOf(int ms) const;  ///< rounded up

  /// All of a bench file but `emulator`, which is the emulated drives' own.
  void describe(ConfigVisitor& v);
  std::size_t longestPdo() const;  ///< in bytes

 private:
  void describeNetwork(ConfigVisitor& v);
  void describeBuses(ConfigVisitor& v);
  void describeDrives(ConfigVisitor& v);
};

/// Reads what BenchConfig describes, and refuses what does not go together.
/// @throw InputError with file, line and column.
BenchConfig readBenchConfig(const ConfigNode& tree);

}  // namespace ballbot
