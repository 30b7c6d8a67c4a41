#include "hil/bench_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "hil/canopen_codec.hpp"
#include "hil/cia402.hpp"
#include "hil/drive_setup.hpp"
#include "hil/sdo_exchange.hpp"

namespace ballbot {
namespace {

/// SDO uploads from one node over one bus. What is not given is noted in the report.
class Reader {
 public:
  Reader(CanBus& bus, int node, bool flexible, std::chrono::milliseconds patience,
         NodeReport& report)
      : exchange_(bus, node, patience, flexible), report_(report) {}

  std::optional<std::int64_t> number(const char* what, std::uint16_t index, std::uint8_t sub = 0) {
    return noted(what, exchange_.number(index, sub));
  }
  /// The number times `unit`.
  std::optional<double> quantity(const char* what, double unit, std::uint16_t index,
                                 std::uint8_t sub = 0) {
    const auto value = number(what, index, sub);
    if (!value) return std::nullopt;
    return unit * static_cast<double>(*value);
  }
  std::optional<std::string> text(const char* what, std::uint16_t index) {
    return noted(what, exchange_.text(index));
  }

 private:
  template <typename Value>
  std::optional<Value> noted(const char* what, std::optional<Value> value) {
    if (!value) report_.not_given.push_back(exchange_.whyNot(what));
    return value;
  }

  SdoExchange exchange_;
  NodeReport& report_;
};

std::optional<std::int64_t> readIdentity(Reader& reader, NodeReport& report) {
  const auto type = reader.number("device type", 0x1000);
  report.found = type.has_value();
  if (!report.found) return type;
  report.device = reader.text("device name", 0x1008);
  report.firmware = reader.text("software version", 0x100A);
  report.vendor = reader.number("vendor", 0x1018, 1);
  report.product = reader.number("product code", 0x1018, 2);
  report.serial = reader.number("serial number", 0x1018, 4);
  report.error_register = reader.number("error register", 0x1001);
  return type;
}

void compare(NodeReport& report, const char* what, const std::optional<double>& is,
             double configured) {
  if (!is) {
    report.disagreements.push_back(
        fmt::format("{} was not given, configured {:.6g}", what, configured));
  } else if (std::abs(*is - configured) > 1e-6 * std::abs(configured)) {
    report.disagreements.push_back(
        fmt::format("{} is {:.6g}, configured {:.6g}", what, *is, configured));
  }
}

void compareMaxTorque(NodeReport& report, double limit_Nm) {
  if (!report.max_torque_Nm) {
    report.disagreements.push_back(
        fmt::format("max torque was not given, the limit asks for {:.4g} Nm", limit_Nm));
  } else if (*report.max_torque_Nm < limit_Nm * (1 - 1e-9)) {
    report.disagreements.push_back(fmt::format("max torque is {:.4g} Nm, the limit asks for {:.4g}",
                                               *report.max_torque_Nm, limit_Nm));
  }
}

void readDrive(Reader& reader, std::int64_t type, const DriveConfig& drive,
               const BenchConfig& config, NodeReport& report) {
  if ((type & 0xFFFF) != 402) {
    report.disagreements.push_back(fmt::format("device type {:08X} is no CiA 402 drive", type));
    return;
  }
  report.is_drive = true;
  const ObjectAddress scale = drive.torque_reference_object;
  report.rated_torque_Nm = reader.quantity("rated torque", 1e-3, 0x6076);
  const std::optional<double> reference =
      scale == ObjectAddress{0x6076, 0}
          ? report.rated_torque_Nm
          : reader.quantity("torque of 1000 counts", 1e-3, scale.index, scale.sub);
  if (const auto most = reader.number("max torque", 0x6072); most && reference) {
    report.max_torque_Nm = *reference * static_cast<double>(*most) / 1000;
  }
  report.encoder_counts = reader.number("encoder increments", 0x608F, 1);
  report.supply_V = reader.quantity("supply voltage", 1e-3, 0x6079);
  if (const auto heat = reader.number("temperature", 0x2000)) {
    report.temperature_degC = 0.1 * static_cast<double>(static_cast<std::int16_t>(*heat));
  }
  if (const auto word = reader.number("statusword", 0x6041)) {
    const DriveState state = driveState(static_cast<std::uint16_t>(*word));
    report.state = toText(state);
    if (state == DriveState::kOperationEnabled || state == DriveState::kQuickStopActive) {
      report.disagreements.push_back(
          "its torque is on, and no program of this bench commands it: pull its switch, or serve "
          "the "
          "bench, which takes the torque off first");
    }
  }
  const auto error = static_cast<std::uint16_t>(reader.number("error code", 0x603F).value_or(0));
  if (error != 0) report.last_error = fmt::format("{:04X} {}", error, errorCodeText(error));
  compare(report, scale.index == 0x6076 ? "rated torque [Nm]" : "torque of 1000 counts [Nm]",
          reference, drive.scaling.torque_reference);
  std::optional<double> counts;
  if (report.encoder_counts) counts = static_cast<double>(*report.encoder_counts);
  compare(report, "encoder increments", counts, drive.scaling.encoder_counts);
  compareMaxTorque(report, drive.limits.torque);
  if (!report.state) report.disagreements.push_back("statusword was not given");
  const std::int8_t mode =
      config.mode == DriveMode::kTorque ? kModeCyclicTorque : kModeCyclicPosition;
  const auto modes = reader.number("supported modes", 0x6502);
  if ((modes.value_or(0) & supportedModeBit(mode)) == 0) {
    report.disagreements.push_back(
        fmt::format("mode of operation {} is not {}", mode, modes ? "supported" : "promised"));
  }
}

/// That the device is the one its data sheet is of.
void compareIdentity(const NamedDataSheet& named, NodeReport& report) {
  if (!named || !report.found) return;
  const auto compareNumber = [&](const char* what, const std::optional<std::int64_t>& is,
                                 const std::optional<std::int64_t>& promised) {
    if (!promised || !is || *is == *promised) return;
    report.disagreements.push_back(
        fmt::format("{} is {:#x}, {} says {:#x}", what, *is, named->file(), *promised));
  };
  compareNumber("vendor", report.vendor, named->vendorNumber());
  compareNumber("product code", report.product, named->productNumber());
}

/// A report that knows where its node is.
NodeReport reportOf(const std::string& name, int bus, int node, const NamedDataSheet& named) {
  NodeReport report;
  report.name = name;
  report.bus = bus;
  report.node = node;
  if (named) {
    report.data_sheet = fmt::format("{}: {}, {}", named->file(), named->vendor(), named->product());
  }
  return report;
}

}  // namespace

bool isEmulated(const NodeReport& node) noexcept {
  return isEmulatedDevice(node.vendor.value_or(-1), node.product.value_or(0));
}

std::vector<NodeReport> checkBench(const BenchConfig& config, const std::vector<CanBus*>& buses) {
  const std::chrono::milliseconds patience(config.sdo_timeout_ms);
  const auto bus = [&](int number) -> CanBus& { return *buses[static_cast<std::size_t>(number)]; };
  std::vector<NodeReport> reports;
  for (const DriveConfig& drive : config.drives) {
    NodeReport report = reportOf(drive.name, drive.bus, drive.node, drive.data_sheet);
    Reader reader(bus(drive.bus), drive.node, config.flexible(), patience, report);
    if (const auto type = readIdentity(reader, report)) {
      readDrive(reader, *type, drive, config, report);
    }
    compareIdentity(drive.data_sheet, report);
    reports.push_back(std::move(report));
  }
  NodeReport imu = reportOf("IMU", config.imu.bus, config.imu.node, config.imu.data_sheet);
  Reader reader(bus(imu.bus), imu.node, config.flexible(), patience, imu);
  if (readIdentity(reader, imu)) {
    compare(imu, "accelerometer resolution [m/s^2]",
            reader.quantity("accelerometer resolution", 1e-9, 0x2004, 1),
            config.imu.accel_resolution);
    compare(imu, "gyro resolution [rad/s]", reader.quantity("gyro resolution", 1e-9, 0x2004, 2),
            config.imu.gyro_resolution);
  }
  compareIdentity(config.imu.data_sheet, imu);
  reports.push_back(std::move(imu));
  return reports;
}

}  // namespace ballbot
