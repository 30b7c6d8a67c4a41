// The object dictionary of an emulated drive.
#include <algorithm>

#include "hil/emulator/drive_node.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kSupportedModes = 1 << 7 | 1 << 9;
}  // namespace

void DriveNode::addOptions(const EmulatedDriveParameters& p) {
  ObjectDictionary& d = dictionary();
  using A = OdAccess;
  using T = OdType;
  const auto option = [&](std::uint16_t index, const char* name, const std::vector<int>& values,
                          int usual) {
    const bool has_usual = std::find(values.begin(), values.end(), usual) != values.end();
    OdEntry& e =
        d.variable(index, name, T::kI16, A::kReadWrite, has_usual ? usual : values.front());
    e.low = *std::min_element(values.begin(), values.end());
    e.high = *std::max_element(values.begin(), values.end());
  };
  d.variable(0x2000, "Drive temperature in 0.1 degC", T::kI16, A::kReadOnly, 315).mappable = true;
  d.structure(0x2010, "Position loop", OdShape::kRecord);
  d.sub(0x2010, 1, "Stiffness in mNm per rad", T::kU32, A::kReadWrite, 0);
  d.sub(0x2010, 2, "Damping in mNm s per rad", T::kU32, A::kReadWrite, 0);
  option(0x6007, "Abort connection option code", p.abort_connection_options, 1);
  option(0x605A, "Quick stop option code", p.quick_stop_options, 2);
  option(0x605E, "Fault reaction option code", p.fault_reaction_options, 2);
  d.structure(0x2020, "Test stand", OdShape::kRecord);
  OdEntry& stand = d.sub(0x2020, 1, "Output: 0 no stand, 1 blocked, 2 free, 3 turned", T::kU8,
                         A::kReadWrite, kNoStand);
  stand.low = kNoStand;
  stand.high = static_cast<std::int64_t>(StandOutput::kTurned);
  d.structure(0x60C2, "Interpolation time period", OdShape::kRecord);
  OdEntry& period = d.sub(0x60C2, 1, "Interpolation time period value", T::kU8, A::kReadWrite, 25);
  period.low = 1;
  OdEntry& exponent = d.sub(0x60C2, 2, "Interpolation time index", T::kI8, A::kReadWrite, -4);
  exponent.low = -6;
  exponent.high = 0;
  d.variable(0x6502, "Supported drive modes", T::kU32, A::kReadOnly, kSupportedModes);
}

void DriveNode::addControl(const EmulatedDriveParameters& p) {
  ObjectDictionary& d = dictionary();
  using A = OdAccess;
  using T = OdType;
  const auto input = [&](std::uint16_t index, const char* name, T type) {
    d.variable(index, name, type, A::kReadOnly, 0).mappable = true;
  };
  const auto output = [&](std::uint16_t index, const char* name, T type, std::int64_t value) {
    d.variable(index, name, type, A::kReadWrite, value).mappable = true;
  };
  input(0x603F, "Error code", T::kU16);
  output(0x6040, "Controlword", T::kU16, 0);
  input(0x6041, "Statusword", T::kU16);
  output(0x6060, "Modes of operation", T::kI8, 0);
  input(0x6061, "Modes of operation display", T::kI8);
  input(0x6064, "Position actual value", T::kI32);
  input(0x606C, "Velocity actual value", p.velocity_bits == 16 ? T::kI16 : T::kI32);
  output(0x6071, "Target torque", T::kI16, 0);
  output(0x6072, "Max torque", T::kU16, p.max_torque_per_mille);
  input(0x6074, "Torque demand", T::kI16);
  d.variable(0x6075, "Motor rated current", T::kU32, A::kReadOnly, p.rated_current_mA);
  d.variable(0x6076, "Motor rated torque", T::kU32, A::kReadOnly, p.rated_torque_mNm);
  if (p.torque_reference_mNm != 0) {
    d.variable(0x2031, "Torque of 1000 counts in mNm", T::kU32, A::kConst, p.torque_reference_mNm);
  }
  input(0x6077, "Torque actual value", T::kI16);
  input(0x6078, "Current actual value", T::kI16);
  d.variable(0x6079, "DC link circuit voltage", T::kU32, A::kReadOnly, 48'000).mappable = true;
  output(0x607A, "Target position", T::kI32, 0);
  d.variable(0x6087, "Torque slope", T::kU32, A::kReadWrite, 100'000).low = 1;
  output(0x60B1, "Velocity offset", T::kI32, 0);
  output(0x60B2, "Torque offset", T::kI16, 0);
}

void DriveNode::addEncoders(const EmulatedDriveParameters& p) {
  ObjectDictionary& d = dictionary();
  using A = OdAccess;
  using T = OdType;
  d.structure(0x608F, "Position encoder resolution", OdShape::kArray);
  d.sub(0x608F, 1, "Encoder increments", T::kU32, A::kReadOnly, p.encoder_counts);
  d.sub(0x608F, 2, "Motor revolutions", T::kU32, A::kReadOnly, 1);
  if (!p.motor_encoder) return;
  d.structure(0x60E4, "Additional position actual value", OdShape::kArray);
  d.sub(0x60E4, 1, "1st additional position actual value", T::kI32, A::kReadOnly, 0).mappable =
      true;
  d.structure(0x60E6, "Additional position encoder resolution - encoder increments",
              OdShape::kArray);
  d.sub(0x60E6, 1, "1st additional encoder increments", T::kU32, A::kReadOnly,
        p.motor_encoder_counts);
  d.structure(0x60EB, "Additional position encoder resolution - motor revolutions",
              OdShape::kArray);
  d.sub(0x60EB, 1, "1st additional motor revolutions", T::kU32, A::kReadOnly, 1);
}

void DriveNode::addObjects(const EmulatedDriveParameters& p) {
  addOptions(p);
  addControl(p);
  addEncoders(p);
  pdos().addReceive(0, {0x60400010, 0x60710010}, 255);
  pdos().addReceive(1, {0x60400010, 0x60B20010, 0x607A0020}, 255);
  pdos().addReceive(2, {0x60B10020}, 255);
  pdos().addReceive(3, {}, 255);
  pdos().addTransmit(0, {0x60410010, 0x60770010, 0x60640020}, 1);
  pdos().addTransmit(1, {p.velocity_bits == 16 ? 0x606C0010U : 0x606C0020U}, 1);
  if (p.motor_encoder) {
    pdos().addTransmit(2, {0x60E40120}, 255);
  } else {
    pdos().addTransmit(2, {}, 255);
  }
  pdos().addTransmit(3, {}, 255);
}

}  // namespace ballbot
