#include "plant/motion_capture.hpp"

#include "core/angle.hpp"
#include "core/config_reader.hpp"

namespace ballbot {

MotionCaptureParameters MotionCaptureParameters::read(ConfigReader in) {
  MotionCaptureParameters p;
  p.period = in.durationOr("period_ms", p.period, {0.1, 1e4});
  p.delay = in.durationOr("delay_ms", p.delay, {0, 1e4});
  p.position_noise = in.numberOr("position_noise_m", p.position_noise, {0, kInf});
  p.yaw_noise = kRadPerDeg * in.numberOr("yaw_noise_deg", p.yaw_noise / kRadPerDeg, {0, kInf});
  in.finish();
  return p;
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
