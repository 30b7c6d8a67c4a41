#include "hil/drive_setup.hpp"

#include <cmath>

#include "hil/canopen_codec.hpp"
#include "hil/cia402.hpp"
#include "hil/shared_outputs.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kPdoOff = 0x80000000, kNoRtr = 0x40000000;
constexpr std::int64_t kOnReception = 255, kEverySync = 1;
constexpr std::int64_t kServoDrive = 0x00020192;

class Script {
 public:
  void write(std::uint16_t index, int sub, int size, std::int64_t value, const char* what) {
    const ObjectAddress o{index, static_cast<std::uint8_t>(sub)};
    add({SetupStep::Kind::kWrite, o, o, static_cast<std::uint8_t>(size), value, what});
  }
  void require(SetupStep::Kind kind, std::uint16_t index, int sub, std::int64_t value,
               const char* what) {
    const ObjectAddress o{index, static_cast<std::uint8_t>(sub)};
    add({kind, o, o, 0, value, what});
  }
  void add(const SetupStep& step) { steps.push_back(step); }
  /// The step before is read back again and again: torque depends on it.
  void watch() { steps.back().watched = true; }
  std::vector<SetupStep> steps;
};

/// Switches a PDO off, maps it anew and switches it on again; or leaves it off.
/// @param identifier  of its frames
void setUpPdo(Script& s, bool transmit, int number, std::uint32_t identifier, const PdoMapping* map,
              std::int64_t transmission, int deadline_ms) {
  const auto parameters = static_cast<std::uint16_t>((transmit ? 0x1800 : 0x1400) + number);
  const auto mapping = static_cast<std::uint16_t>((transmit ? 0x1A00 : 0x1600) + number);
  const std::int64_t id = identifier + (transmit ? kNoRtr : 0);
  s.write(parameters, 1, 4, id + kPdoOff, "PDO off");
  if (map == nullptr) return;
  s.write(mapping, 0, 1, 0, "PDO mapping count");
  int sub = 0;
  for (const PdoEntry& entry : map->entries()) {
    s.write(mapping, ++sub, 4, entry.code(), "PDO mapping");
  }
  s.write(mapping, 0, 1, sub, "PDO mapping count");
  s.write(parameters, 2, 1, transmission, "PDO transmission type");
  if (!transmit) s.write(parameters, 5, 2, deadline_ms, "RPDO deadline");
  s.write(parameters, 1, 4, id, "PDO on");
}

bool isEmulated(const DataSheet& sheet) {
  return isEmulatedDevice(sheet.vendorNumber().value_or(-1), sheet.productNumber().value_or(0));
}

/// That the device is the one its data sheet is of, and that it is an emulated one where it must
/// be: between two steps nobody watches the time, and a drive holds what it was told last. Only
/// drives whose clock is SYNC may be told so.
void requireIdentity(Script& s, const BenchConfig& bench, const NamedDataSheet& data_sheet,
                     std::int64_t emulated_product) {
  const DataSheet* sheet = data_sheet.sheet.get();
  if (bench.stepped) {
    const bool known = sheet != nullptr && isEmulated(*sheet);
    s.require(SetupStep::Kind::kExpect, 0x1018, 2,
              known ? *sheet->productNumber() : emulated_product,
              "product code (stepped: true is for emulated drives alone, real ones need false)");
  } else if (sheet != nullptr && sheet->productNumber()) {
    s.require(SetupStep::Kind::kExpect, 0x1018, 2, *sheet->productNumber(),
              "product code, by its data sheet");
  }
  if (sheet != nullptr && sheet->vendorNumber().value_or(0) != 0) {
    s.require(SetupStep::Kind::kExpect, 0x1018, 1, *sheet->vendorNumber(),
              "vendor, by its data sheet");
  }
}

void setUpHeartbeats(Script& s, const BenchConfig& bench) {
  s.write(0x1017, 0, 2, bench.drive_heartbeat_ms, "heartbeat period");
  s.write(0x1016, 1, 4,
          static_cast<std::int64_t>(bench.master_node) << 16 | bench.master_timeout_ms,
          "watch over the master");
  s.watch();
}

}  // namespace

std::vector<SetupStep> driveSetup(const BenchConfig& bench, const DriveConfig& drive) {
  using Kind = SetupStep::Kind;
  const bool torque = bench.mode == DriveMode::kTorque;
  const std::int8_t mode = torque ? kModeCyclicTorque : kModeCyclicPosition;
  const DriveScaling& scale = drive.scaling;
  Script s;
  s.require(Kind::kExpect, 0x1000, 0, kServoDrive, "device type of a CiA 402 servo drive");
  requireIdentity(s, bench, drive.data_sheet, kEmulatedDrive);
  s.require(Kind::kExpectBits, 0x6502, 0, supportedModeBit(mode), "supported drive modes");
  const ObjectAddress reference = drive.torque_reference_object;
  s.require(Kind::kExpect, reference.index, reference.sub,
            std::llround(1000 * scale.torque_reference),
            reference.index == 0x6076 ? "rated torque in mNm" : "torque of 1000 counts in mNm");
  s.watch();
  s.require(Kind::kExpect, 0x608F, 1, std::llround(scale.encoder_counts), "encoder increments");
  s.watch();
  const std::int64_t limit = std::llround(1000 * drive.limits.torque / scale.torque_reference);
  s.require(Kind::kAtLeast, 0x6072, 0, limit, "max torque in per mille");

  for (int i = 0; i < 4; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const auto node = static_cast<std::uint32_t>(drive.node);
    const bool shared = bench.shared_outputs && i == 0;
    const PdoMapping* own = n < bench.outputs.size() ? &bench.outputs[n] : nullptr;
    const PdoMapping all = shared ? sharedOutputs(bench, drive) : PdoMapping{};
    setUpPdo(s, false, i, shared ? sharedIdentifier(bench, drive.bus) : kCobRpdo[n] + node,
             shared ? &all : own, bench.synchronous_outputs ? kEverySync : kOnReception,
             bench.output_deadline_ms);
    setUpPdo(s, true, i, kCobTpdo[n] + node, n < bench.inputs.size() ? &bench.inputs[n] : nullptr,
             kEverySync, 0);
  }
  setUpHeartbeats(s, bench);
  s.write(0x1029, 1, 1, 0, "behaviour without the master");
  s.write(0x6007, 0, 2, drive.abort_connection_option, "abort connection option");
  s.watch();
  s.write(0x605A, 0, 2, drive.quick_stop_option, "quick stop option");
  s.write(0x605E, 0, 2, drive.fault_reaction_option, "fault reaction option");
  s.write(0x6072, 0, 2, limit, "max torque");
  s.watch();
  const std::int64_t ns = bench.cycle.count();
  if (ns % 100'000 == 0 && ns / 100'000 <= 255) {
    s.write(0x60C2, 2, 1, -4, "interpolation time index");
    s.write(0x60C2, 1, 1, ns / 100'000, "interpolation time");
  }
  if (!torque) {
    s.write(0x2010, 1, 4, std::llround(1000 * drive.stiffness), "position loop stiffness");
    s.write(0x2010, 2, 4, std::llround(1000 * drive.damping), "position loop damping");
  }
  s.add({Kind::kWrite, {0x6060, 0}, {0x6061, 0}, 1, mode, "mode of operation"});
  s.watch();
  return s.steps;
}

std::vector<SetupStep> imuSetup(const BenchConfig& bench) {
  using Kind = SetupStep::Kind;
  Script s;
  requireIdentity(s, bench, bench.imu.data_sheet, kEmulatedImu);
  s.require(Kind::kExpect, 0x2004, 1, std::llround(1e9 * bench.imu.accel_resolution),
            "accelerometer resolution in 1e-9 m/s^2");
  s.require(Kind::kExpect, 0x2004, 2, std::llround(1e9 * bench.imu.gyro_resolution),
            "gyro resolution in 1e-9 rad/s");
  // As it is delivered it sends two frames; CAN FD has room for all in one.
  if (bench.flexible()) {
    const PdoMapping all = imuMapping();
    const auto node = static_cast<std::uint32_t>(bench.imu.node);
    setUpPdo(s, true, 0, kCobTpdo[0] + node, &all, kEverySync, 0);
    setUpPdo(s, true, 1, kCobTpdo[1] + node, nullptr, kEverySync, 0);
  }
  setUpHeartbeats(s, bench);
  return s.steps;
}

PdoMapping imuMapping() {
  return PdoMapping({{{0x2001, 1}, 16},
                     {{0x2001, 2}, 16},
                     {{0x2001, 3}, 16},
                     {{0x2003, 0}, 16},
                     {{0x2002, 1}, 16},
                     {{0x2002, 2}, 16},
                     {{0x2002, 3}, 16}});
}

}  // namespace ballbot
