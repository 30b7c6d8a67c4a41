#include "hil/record/object_words.hpp"

#include <fmt/format.h>

#include "hil/canopen_codec.hpp"
#include "hil/cia402.hpp"

namespace ballbot {
namespace {

enum class Unit { kNumber, kHex, kStatus, kControl, kTorque, kAngle, kMotorAngle, kVelocity };

constexpr int kAnySub = -1;
struct Row {
  std::uint16_t first, last;  ///< index
  int sub;
  const char* name;
  Unit unit = Unit::kNumber;
};
// From the most to the least specific.
constexpr Row kRows[] = {
    {0x1000, 0x1000, 0, "device type", Unit::kHex},
    {0x1001, 0x1001, 0, "error register", Unit::kHex},
    {0x1008, 0x1008, 0, "device name", Unit::kHex},
    {0x100A, 0x100A, 0, "firmware", Unit::kHex},
    {0x1016, 0x1016, kAnySub, "watch over the master", Unit::kHex},
    {0x1017, 0x1017, 0, "heartbeat period in ms"},
    {0x1018, 0x1018, kAnySub, "identity", Unit::kHex},
    {0x1029, 0x1029, kAnySub, "behaviour without the master"},
    {0x1400, 0x15FF, 1, "RPDO identifier", Unit::kHex},
    {0x1400, 0x15FF, 2, "RPDO transmission type"},
    {0x1400, 0x15FF, 5, "RPDO deadline in ms"},
    {0x1600, 0x17FF, 0, "RPDO mapping count"},
    {0x1600, 0x17FF, kAnySub, "RPDO mapping", Unit::kHex},
    {0x1800, 0x19FF, 1, "TPDO identifier", Unit::kHex},
    {0x1800, 0x19FF, 2, "TPDO transmission type"},
    {0x1A00, 0x1BFF, 0, "TPDO mapping count"},
    {0x1A00, 0x1BFF, kAnySub, "TPDO mapping", Unit::kHex},
    {0x2000, 0x2000, 0, "temperature in 0.1 degC"},
    {0x2004, 0x2004, 1, "accelerometer resolution in 1e-9 m/s^2"},
    {0x2004, 0x2004, 2, "gyro resolution in 1e-9 rad/s"},
    {0x2010, 0x2010, 1, "position loop stiffness"},
    {0x2010, 0x2010, 2, "position loop damping"},
    {0x6007, 0x6007, 0, "abort connection option"},
    {0x603F, 0x603F, 0, "error code", Unit::kHex},
    {0x6040, 0x6040, 0, "controlword", Unit::kControl},
    {0x6041, 0x6041, 0, "statusword", Unit::kStatus},
    {0x605A, 0x605A, 0, "quick stop option"},
    {0x605E, 0x605E, 0, "fault reaction option"},
    {0x6060, 0x6060, 0, "mode of operation"},
    {0x6061, 0x6061, 0, "mode of operation shown"},
    {0x6064, 0x6064, 0, "joint angle", Unit::kAngle},
    {0x606C, 0x606C, 0, "joint velocity", Unit::kVelocity},
    {0x6071, 0x6071, 0, "torque command", Unit::kTorque},
    {0x6072, 0x6072, 0, "max torque in per mille"},
    {0x6074, 0x6074, 0, "torque demand", Unit::kTorque},
    {0x6076, 0x6076, 0, "rated torque in mNm"},
    {0x6077, 0x6077, 0, "torque", Unit::kTorque},
    {0x6079, 0x6079, 0, "supply in mV"},
    {0x607A, 0x607A, 0, "position command", Unit::kAngle},
    {0x608F, 0x608F, 1, "encoder increments"},
    {0x60B1, 0x60B1, 0, "velocity offset", Unit::kVelocity},
    {0x60B2, 0x60B2, 0, "torque offset", Unit::kTorque},
    {0x60C2, 0x60C2, 1, "interpolation time"},
    {0x60C2, 0x60C2, 2, "interpolation time index"},
    {0x60E4, 0x60E4, 1, "motor angle", Unit::kMotorAngle},
    {0x6502, 0x6502, 0, "supported drive modes", Unit::kHex},
};

const Row* rowOf(ObjectAddress object) noexcept {
  for (const Row& row : kRows) {
    const bool sub = row.sub == kAnySub || row.sub == object.sub;
    if (object.index >= row.first && object.index <= row.last && sub) return &row;
  }
  return nullptr;
}

std::string valueText(Unit unit, const std::uint8_t* bytes, std::size_t size,
                      const DriveConfig* drive) {
  const std::uint64_t raw = getLittleEndian(bytes, size);
  const std::int64_t value = getSigned(bytes, size);
  const auto hex = [&] { return fmt::format("{:0{}X}", raw, 2 * size); };
  const auto word = static_cast<std::uint16_t>(raw);
  switch (unit) {
    case Unit::kHex:
      return hex();
    case Unit::kStatus:
      return fmt::format("{} ({})", hex(), toText(driveState(word)));
    case Unit::kControl:
      return fmt::format("{} ({})", hex(), controlwordText(word));
    case Unit::kNumber:
      return std::to_string(value);
    default:
      break;
  }
  if (drive == nullptr) return std::to_string(value);
  const DriveScaling& scale = drive->scaling;
  switch (unit) {
    case Unit::kTorque:
      return fmt::format("{:.6g} Nm", scale.torque(value));
    case Unit::kAngle:
      return fmt::format("{:.6g} rad", scale.angle(value));
    case Unit::kMotorAngle:
      return fmt::format("{:.6g} rad", scale.motorAngle(value));
    default:
      return fmt::format("{:.6g} rad/s", scale.velocity(value));
  }
}

}  // namespace

const char* nameOf(ObjectAddress object) noexcept {
  const Row* row = rowOf(object);
  return row == nullptr ? "" : row->name;
}

std::string objectText(ObjectAddress object, const std::uint8_t* bytes, std::size_t size,
                       const DriveConfig* drive) {
  const Row* row = rowOf(object);
  const std::string value = valueText(row == nullptr ? Unit::kHex : row->unit, bytes, size, drive);
  return row == nullptr ? fmt::format("{} {}", toText(object), value)
                        : fmt::format("{} {} {}", toText(object), row->name, value);
}

const char* controlwordText(std::uint16_t word) noexcept {
  if ((word & kFaultReset) != 0) return "fault reset";
  switch (word & 0x0F) {
    case kDisableVoltage:
      return "disable voltage";
    case kQuickStopCommand:
      return "quick stop";
    case kShutdown:
      return "shutdown";
    case kSwitchOn:
      return "switch on";
    case kEnableOperation:
      return "enable operation";
    default:
      return "no command of CiA 402";
  }
}

}  // namespace ballbot
