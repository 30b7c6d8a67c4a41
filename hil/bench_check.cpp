#include "hil/bench_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hil/canopen_codec.hpp"
#include "hil/cia402.hpp"
#include "hil/drive_setup.hpp"
#include "hil/sdo_exchange.hpp"

namespace ballbot {
namespace {

void readIdentity(SdoExchange& reader, NodeReport& report) {
  report.found = reader.number(0x1000).has_value();
  if (!report.found) return;
  report.device = reader.text(0x1008);
  report.firmware = reader.text(0x100A);
  report.vendor = static_cast<std::uint32_t>(reader.number(0x1018, 1).value_or(0));
  report.product = static_cast<std::uint32_t>(reader.number(0x1018, 2).value_or(0));
  report.serial = static_cast<std::uint32_t>(reader.number(0x1018, 4).value_or(0));
  report.error_register = reader.number(0x1001).value_or(0);
}

void compare(NodeReport& report, const char* what, double is, double configured) {
  if (std::abs(is - configured) <= 1e-6 * std::abs(configured)) return;
  report.disagreements.push_back(
      fmt::format("{} is {:.6g}, configured {:.6g}", what, is, configured));
}

void readDrive(SdoExchange& reader, const DriveConfig& drive, const BenchConfig& config,
               NodeReport& report) {
  const std::int64_t type = reader.number(0x1000).value_or(0);
  if ((type & 0xFFFF) != 402) {
    report.disagreements.push_back(fmt::format("device type {:08X} is no CiA 402 drive", type));
    return;
  }
  report.rated_torque_Nm = 1e-3 * static_cast<double>(reader.number(0x6076).value_or(0));
  report.max_torque_Nm =
      report.rated_torque_Nm * static_cast<double>(reader.number(0x6072).value_or(0)) / 1000;
  report.encoder_counts = reader.number(0x608F, 1).value_or(0);
  report.supply_V = 1e-3 * static_cast<double>(reader.number(0x6079).value_or(0));
  report.temperature_degC =
      0.1 * static_cast<double>(static_cast<std::int16_t>(reader.number(0x2000).value_or(0)));
  report.state = toText(driveState(static_cast<std::uint16_t>(reader.number(0x6041).value_or(0))));
  const auto error = static_cast<std::uint16_t>(reader.number(0x603F).value_or(0));
  if (error != 0) report.last_error = fmt::format("{:04X} {}", error, errorCodeText(error));
  compare(report, "rated torque [Nm]", report.rated_torque_Nm, drive.scaling.torque_reference);
  compare(report, "encoder increments", static_cast<double>(report.encoder_counts),
          drive.scaling.encoder_counts);
  if (report.max_torque_Nm < drive.limits.torque * (1 - 1e-9)) {
    report.disagreements.push_back(fmt::format("max torque is {:.4g} Nm, the limit asks for {:.4g}",
                                               report.max_torque_Nm, drive.limits.torque));
  }
  const std::int8_t mode =
      config.mode == DriveMode::kTorque ? kModeCyclicTorque : kModeCyclicPosition;
  const std::int64_t modes = reader.number(0x6502).value_or(0);
  if ((modes & supportedModeBit(mode)) == 0) {
    report.disagreements.push_back(fmt::format("mode of operation {} is not supported", mode));
  }
}

}  // namespace

bool isEmulated(const NodeReport& node) noexcept {
  return node.product == kEmulatedDrive || node.product == kEmulatedImu;
}

std::vector<NodeReport> checkBench(const BenchConfig& config, const std::vector<CanBus*>& buses,
                                   std::chrono::milliseconds patience) {
  std::vector<NodeReport> reports;
  for (const DriveConfig& drive : config.drives) {
    NodeReport report;
    report.name = drive.name;
    report.bus = drive.bus;
    report.node = drive.node;
    SdoExchange reader(*buses[static_cast<std::size_t>(drive.bus)], drive.node, patience);
    readIdentity(reader, report);
    if (report.found) readDrive(reader, drive, config, report);
    reports.push_back(report);
  }
  NodeReport imu;
  imu.name = "IMU";
  imu.bus = config.imu.bus;
  imu.node = config.imu.node;
  SdoExchange reader(*buses[static_cast<std::size_t>(imu.bus)], imu.node, patience);
  readIdentity(reader, imu);
  if (imu.found) {
    compare(imu, "accelerometer resolution [m/s^2]",
            1e-9 * static_cast<double>(reader.number(0x2004, 1).value_or(0)),
            config.imu.accel_resolution);
    compare(imu, "gyro resolution [rad/s]",
            1e-9 * static_cast<double>(reader.number(0x2004, 2).value_or(0)),
            config.imu.gyro_resolution);
  }
  reports.push_back(imu);
  return reports;
}

}  // namespace ballbot
