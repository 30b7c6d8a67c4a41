#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/config_visitor.hpp"
#include "core/time.hpp"
#include "hil/emulator/drive_node.hpp"
#include "hil/emulator/elastic_rig.hpp"

namespace ballbot {

/// A fault on demand.
enum class EmulatedFault {
  kEmergency,         ///< internal fault of a drive with emergency code `value`
  kUnannouncedFault,  ///< the same without an emergency message getting through
  kHeartbeatLost,     ///< of a drive; everything else goes on
  kPdosLost,          ///< a drive sends no PDOs any more
  kPdosTruncated,     ///< a drive's PDOs are a byte short
  kPowerLoss,         ///< a drive is dead
  kReboot,            ///< a drive starts anew by itself
  kNmtStop,           ///< a drive is told "stop" by somebody else
  kNmtPreOperational,
  kLocalDisable,  ///< a drive falls to switch on disabled by itself
  kStatusword,    ///< a drive's statusword freezes at `value`
  kStuckEncoder,  ///< position freezes, velocity goes on
  kPositionJump,  ///< by `value` rad
  kRunaway,       ///< velocity feedback of `value` rad/s
  kFrozenBus,     ///< nothing passes on the bus of `drive`, either way
  kSyncHeldBack,  ///< the next `value` SYNCs do not reach the bus of `drive`
  kImuLost,       ///< the IMU is dead
  kImuFrozen,     ///< it sends the same sample for ever
  kTilt,          ///< the IMU feels a lean of `value` rad
  kWarning,       ///< a drive raises its warning bit: no reason to stop
};

struct FaultOrder {
  std::int64_t at_cycle = 0;  ///< counted in SYNCs
  EmulatedFault kind = EmulatedFault::kEmergency;
  int drive = 0;  ///< 0 to 5
  double value = 0;
};

/// The emulated bench as its own section of the bench's configuration says it is. It shares no
/// value with the master's, so that a wrong one on either side shows.
struct EmulatorConfig {
  SimDuration cycle{2'500'000};  ///< of SYNC in stepped mode
  bool stepped = false;
  int bus_count = 1;
  std::vector<std::string> links;  ///< of the ptys, one per bus; or socketcan:...
  bool flexible = false;           ///< CAN FD on all of them
  std::array<EmulatedDriveParameters, 6> drives;
  std::array<int, 6> drive_bus{};
  int imu_bus = 0, imu_node = 7;
  double accel_resolution = 4.79e-3, gyro_resolution = 1.065e-3;
  std::vector<FaultOrder> faults;

  /// Independent joints in the robot's place, see JointRig; false: the scenario's plant.
  bool rig = false;
  double rig_bandwidth_Hz = 40, rig_damping_ratio = 0.7071067811865476, rig_delay_ms = 0;
  bool rig_blocked = false;
  /// Series elastic actuators on the rig instead of joints with an exactly known response.
  std::optional<ElasticRigOptions> elastic_rig;

  /// The section `emulator`.
  void describe(ConfigVisitor& v);

 private:
  void describeBuses(ConfigVisitor& v);
  void describeDrives(ConfigVisitor& v);
};

constexpr ConfigKey emulatorSection() {
  return may("emulator",
             "what `ballbot drives` emulates; of the adapter's part it reads the clock");
}

/// Reads `emulator:` of the bench file, and `cycle_us` and `stepped`, which both sides must share.
/// @throw InputError with file, line and column.
EmulatorConfig readEmulatorConfig(const ConfigNode& tree);

}  // namespace ballbot
