#include "hil/cycle_csv.hpp"

#include <fmt/format.h>

namespace ballbot {

std::string cycleCsvHeader() {
  std::string line =
      "cycle,time_s,state,action,fault,wake_late_us,act_late_us,skipped,imu_count,imu_stale,tilt_"
      "rad";
  for (const char* name : {"accel", "gyro"}) {
    for (const char* axis : {"x", "y", "z"}) line += fmt::format(",{}_{}", name, axis);
  }
  for (const char* name : {"angle_rad", "motor_rad", "velocity_rad_per_s", "torque_Nm", "asked_Nm",
                           "sent_Nm", "status", "stale"}) {
    for (int i = 1; i <= kDriveCount; ++i) line += fmt::format(",{}_{}", name, i);
  }
  return line + "\n";
}

std::string cycleCsvLine(const CycleRecord& r) {
  std::string line =
      fmt::format("{},{:.6f},{},{},{},{:.1f},{:.1f},{},{},{},{:.6g}", r.cycle,
                  1e-9 * static_cast<double>(r.time_ns), toText(r.state), toText(r.action),
                  checkOf(r.fault).name, 1e-3 * r.wake_late_ns, 1e-3 * r.act_late_ns, r.skipped,
                  r.sample.imu_count, r.imu_stale, r.tilt);
  for (const auto* axes : {&r.sample.accel, &r.sample.gyro}) {
    for (const double v : *axes) line += fmt::format(",{:.6g}", v);
  }
  for (const DriveArray* a :
       {&r.sample.joint_angle, &r.sample.motor_angle, &r.sample.joint_velocity,
        &r.sample.joint_torque, &r.asked, &r.torque}) {
    for (const double v : *a) line += fmt::format(",{:.9g}", v);
  }
  for (const std::uint16_t word : r.statusword) line += fmt::format(",{:04X}", word);
  for (const std::uint8_t cycles : r.stale) line += fmt::format(",{}", cycles);
  return line + "\n";
}

}  // namespace ballbot
