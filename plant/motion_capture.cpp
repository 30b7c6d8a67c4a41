#include "plant/motion_capture.hpp"

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {

void MotionCaptureParameters::describe(ConfigVisitor& v) {
  v.duration(may("period_ms", "from one pose to the next"), period, {0.1, 1e4});
  v.duration(may("delay_ms", "from the moment a pose holds to its arrival"), delay, {0, 1e4});
  v.number(may("position_noise_m", "standard deviation of the position per axis"), position_noise,
           {0, kInf});
  v.number(may("yaw_noise_deg", "standard deviation of the yaw"), yaw_noise, {0, kInf}, kRadPerDeg);
}

MotionCapture::MotionCapture(const std::optional<MotionCaptureParameters>& p, std::uint64_t seed)
    : present_(p.has_value()),
      p_(p.value_or(MotionCaptureParameters{})),
      noise_(seed, "motion_capture"),
      capacity_(p_.delay / p_.period + 2),
      poses_(static_cast<std::size_t>(3 * capacity_), 0.0) {}

void MotionCapture::reset(SimTime start) {
  start_ = start;
  taken_ = 0;
}

void MotionCapture::take(const Vector3& pose_W) {
  const auto at = static_cast<std::size_t>(3 * (taken_ % capacity_));
  const auto n = noise_.normals(static_cast<std::uint64_t>(taken_++));
  poses_[at] = pose_W.x() + p_.position_noise * n[0];
  poses_[at + 1] = pose_W.y() + p_.position_noise * n[1];
  poses_[at + 2] = pose_W.z() + p_.yaw_noise * n[2];
}

void MotionCapture::report(SimTime now, SensorFrame& frame) const {
  const SimDuration age = now - start_ - p_.delay;
  if (age < SimDuration::zero()) return;
  const std::int64_t newest = age / p_.period;
  const auto at = static_cast<std::size_t>(3 * (newest % capacity_));
  frame.pose_count = newest + 1;
  frame.pose_time = start_ + newest * p_.period;
  frame.pose_W << poses_[at], poses_[at + 1], poses_[at + 2];
}

}  // namespace ballbot
