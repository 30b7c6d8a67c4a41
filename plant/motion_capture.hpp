#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.hpp"
#include "core/time.hpp"
#include "model/signals.hpp"

namespace ballbot {

class ConfigVisitor;

struct MotionCaptureParameters {
  SimDuration period{10'000'000};
  SimDuration delay{30'000'000};  ///< from the moment a pose holds to its arrival
  double position_noise = 0.002;  ///< standard deviation per axis [m]
  double yaw_noise = 0.0035;      ///< [rad]

  /// The `motion_capture:` of the `plant:` section.
  void describe(ConfigVisitor& v);
};

/// An outside system that sees the robot: position of the ball centre and yaw of the base in W, at
/// its own rate, noisy and late. Poses on their way are state.
class MotionCapture {
 public:
  /// Without parameters there is none: no pose ever arrives.
  MotionCapture(const std::optional<MotionCaptureParameters>& p, std::uint64_t seed);

  bool present() const { return present_; }
  SimDuration period() const { return p_.period; }
  void reset(SimTime start);
  /// At whole multiples of the period since the start: the true pose, x, y [m] and yaw [rad].
  void take(const Vector3& pose_W);
  /// What has arrived by `now`.
  void report(SimTime now, SensorFrame& frame) const;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    if (!self.present_) return;
    visit(self.start_);
    visit(self.taken_);
    visit(self.poses_);
  }

 private:
  bool present_;
  MotionCaptureParameters p_;
  RandomStream noise_;
  std::int64_t capacity_;
  SimTime start_{};
  std::int64_t taken_ = 0;
  std::vector<double> poses_;  ///< ring of the last `capacity_`, three numbers each
};

}  // namespace ballbot
