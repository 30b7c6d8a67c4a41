#pragma once

#include <array>
#include <cstdint>

#include "hil/emulator/canopen_node.hpp"

namespace ballbot {

/// An emulated inertial measurement unit as a CANopen node of its own. At every SYNC it sends
///
///   TPDO1  2001:01..03  specific force x, y, z in B, i16 of accel_resolution
///          2003:00      sample counter, u16, grows by one per new sample
///   TPDO2  2002:01..03  angular rate x, y, z in B, i16 of gyro_resolution
///
/// Both resolutions are objects 2004:01 and :02, in nano-units (1e-9 m/s^2 and rad/s per count).
class ImuNode final : public CanopenNode {
 public:
  ImuNode(int node_id, double accel_resolution, double gyro_resolution);

  void setSample(std::int64_t count, const std::array<double, 3>& accel,
                 const std::array<double, 3>& gyro);
  /// As if its processor hung while its CAN controller goes on.
  void freeze(bool on) { frozen_ = on; }

 private:
  void refresh() override;

  double accel_resolution_, gyro_resolution_;
  std::int64_t count_ = 0;
  std::array<double, 3> accel_{}, gyro_{};
  bool frozen_ = false;
};

}  // namespace ballbot
