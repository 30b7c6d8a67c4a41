#include "hil/bench_fault.hpp"

namespace ballbot {
namespace {

using F = BenchFault;
constexpr FirstReaction kDamp = FirstReaction::kDamp, kOff = FirstReaction::kOff;
constexpr const char *kCommand = "bench-command.md", *kLimits = "bench-limits.md",
                     *kImu = "bench-imu.md", *kState = "bench-drive-state.md",
                     *kNetwork = "bench-network.md", *kIntruder = "bench-intruder.md",
                     *kChanged = "bench-parameters.md", *kEncoder = "bench-encoder.md",
                     *kTorque = "bench-torque.md", *kLoop = "bench-loop.md";

constexpr std::array<Check, kCheckCount> kTable = {{
    {F::kNone, "none", "none", FirstReaction::kNone, 0, ""},
    {F::kCommandTimeout, "command_timeout", "no command from the controller", kDamp, 21, kCommand},
    {F::kCommandNotFinite, "command_not_finite", "command is not finite", kDamp, 1, kCommand},
    {F::kCommandGains, "command_gains", "command asks for gains the drives do not have", kDamp, 1,
     kCommand},
    {F::kCommandRepeats, "command_repeats", "the controller sends one command again and again",
     kOff, 8, kCommand},
    {F::kCommandOrder, "command_order", "a command is older than the one before it", kDamp, 1,
     kCommand},
    {F::kCommandAbsurd, "command_absurd", "the controller asks for torque far beyond the limit",
     kDamp, 10, kCommand},
    {F::kVelocityLimit, "velocity_limit", "velocity limit", kDamp, 1, kLimits},
    {F::kPositionLimit, "position_limit", "position limit", kDamp, 1, kLimits},
    {F::kTiltLimit, "tilt_limit", "tilt limit", kDamp, 20, kLimits},
    {F::kImuStale, "imu_stale", "no new IMU samples", kDamp, 3, kImu},
    {F::kLateLoop, "late_loop", "the loop is late", kDamp, 1, kLoop},
    {F::kImuRepeats, "imu_repeats", "the IMU's values repeat bit for bit", kOff, 6, kImu},
    {F::kImuDisagrees, "imu_disagrees", "gyroscope and accelerometer disagree", kOff, 400, kImu},
    {F::kDriveFault, "drive_fault", "a drive is in fault", kOff, 1, kState},
    {F::kDriveDroppedOut, "drive_dropped_out", "a drive left operation enabled", kOff, 1, kState},
    {F::kDriveUnbidden, "drive_unbidden", "a drive has torque that nobody asked it for", kOff, 3,
     kState},
    {F::kDriveTransition, "drive_transition", "a drive does not follow its state commands", kOff,
     41, kState},
    {F::kDriveStale, "drive_stale", "a drive's PDOs are missing", kOff, 3, kNetwork},
    {F::kDriveMisses, "drive_misses", "too many of a drive's PDOs are missing", kOff, 9, kNetwork},
    {F::kNodeTrouble, "node_trouble", "a node failed on the network", kOff, 1, kNetwork},
    {F::kNodeTwin, "node_twin", "two nodes answer as one", kOff, 2, kIntruder},
    {F::kForeignFrame, "foreign_frame", "somebody else sends what is the master's to send", kOff, 1,
     kIntruder},
    {F::kParameterChanged, "parameter_changed", "a parameter of a drive has changed", kOff, 400,
     kChanged},
    {F::kEncoderImplausible, "encoder_implausible", "an encoder's position and velocity disagree",
     kOff, 40, kEncoder},
    {F::kPositionJump, "position_jump", "an encoder's position jumps", kOff, 1, kEncoder},
    {F::kSpringDisagrees, "spring_disagrees",
     "joint encoder, motor encoder and torque do not fit the spring between them", kOff, 3,
     kEncoder},
    {F::kTorqueRepeats, "torque_repeats", "a drive's torque repeats while it should change", kOff,
     8, kTorque},
    {F::kTorqueDiffers, "torque_differs", "a drive's torque is not the one asked for", kOff, 8,
     kTorque},
    {F::kEchoDiffers, "echo_differs", "a drive's torque demand is not the one it was sent", kOff, 3,
     kTorque},
    {F::kSensorNotFinite, "sensor_not_finite", "a measurement is not finite", kOff, 1, kEncoder},
    {F::kBusDown, "bus_down", "a bus is down", kOff, 1, kNetwork},
}};

constexpr bool inOrder() {
  for (std::size_t i = 0; i < kTable.size(); ++i) {
    if (static_cast<std::size_t>(kTable[i].fault) != i) return false;
  }
  return true;
}
static_assert(inOrder(), "a row of the table stands in the wrong place");

}  // namespace

const std::array<Check, kCheckCount>& checkTable() noexcept { return kTable; }

const Check& checkOf(BenchFault fault) noexcept {
  const auto i = static_cast<std::size_t>(fault);
  return kTable[i < kTable.size() ? i : 0];
}

}  // namespace ballbot
