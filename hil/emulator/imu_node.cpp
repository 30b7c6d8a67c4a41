#include "hil/emulator/imu_node.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

constexpr std::uint32_t kNoProfile = 0;
constexpr std::uint32_t kProduct = 0xBA12;
constexpr double kNano = 1e-9;

}  // namespace

ImuNode::ImuNode(int node_id, double accel_resolution, double gyro_resolution)
    : CanopenNode(node_id, kNoProfile, "ballbot emulated IMU", kProduct),
      accel_resolution_(accel_resolution),
      gyro_resolution_(gyro_resolution) {
  ObjectDictionary& d = dictionary();
  const auto axes = [&](std::uint16_t index, const char* name) {
    d.structure(index, name, OdShape::kArray);
    for (std::uint8_t i = 1; i <= 3; ++i) {
      d.sub(index, i, std::string(1, static_cast<char>('w' + i)), OdType::kI16, OdAccess::kReadOnly,
            0)
          .mappable = true;
    }
  };
  axes(0x2001, "Specific force");
  axes(0x2002, "Angular rate");
  d.variable(0x2003, "Sample counter", OdType::kU16, OdAccess::kReadOnly, 0).mappable = true;
  d.structure(0x2004, "Resolution", OdShape::kRecord);
  d.sub(0x2004, 1, "Specific force in 1e-9 m/s^2", OdType::kU32, OdAccess::kConst,
        std::llround(accel_resolution / kNano));
  d.sub(0x2004, 2, "Angular rate in 1e-9 rad/s", OdType::kU32, OdAccess::kConst,
        std::llround(gyro_resolution / kNano));
  pdos().addTransmit(0, {0x20010110, 0x20010210, 0x20010310, 0x20030010}, 1);
  pdos().addTransmit(1, {0x20020110, 0x20020210, 0x20020310}, 1);
  for (int i = 0; i < PdoRules::kPdoCount; ++i) {
    if (i >= 2) pdos().addTransmit(i, {}, 255);
    pdos().addReceive(i, {}, 255);
  }
}

void ImuNode::setSample(std::int64_t count, const std::array<double, 3>& accel,
                        const std::array<double, 3>& gyro) {
  if (frozen_) return;
  count_ = count;
  accel_ = accel;
  gyro_ = gyro;
}

void ImuNode::refresh() {
  ObjectDictionary& d = dictionary();
  const auto put = [&](std::uint16_t index, std::uint8_t sub, double counts) {
    d.set(index, sub, std::llround(std::clamp(counts, -32768.0, 32767.0)));
  };
  for (std::uint8_t i = 0; i < 3; ++i) {
    put(0x2001, static_cast<std::uint8_t>(i + 1), accel_[i] / accel_resolution_);
    put(0x2002, static_cast<std::uint8_t>(i + 1), gyro_[i] / gyro_resolution_);
  }
  d.set(0x2003, count_ & 0xFFFF);
}

}  // namespace ballbot
