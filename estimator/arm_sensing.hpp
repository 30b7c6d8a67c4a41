#pragma once

#include "model/signals.hpp"

namespace ballbot {

/// Arm joints straight from their encoders: angles as measured, rates as the drives compute them,
/// through a first-order low pass. Values that are not finite are passed over.
class ArmSensing {
 public:
  /// @param rate_time_constant_s of the low pass; 0 passes the rates through [s]
  explicit ArmSensing(double rate_time_constant_s) : time_constant_s_(rate_time_constant_s) {}

  void update(const SensorFrame& frame) noexcept;

  /// Arm angles [rad] and rates [rad/s] into `x`, the angles brought forward to `now`.
  void writeTo(SimTime now, StateVector& x) const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.started_);
    visit(self.time_);
    visit(self.angle_);
    visit(self.rate_);
  }

 private:
  double time_constant_s_;
  bool started_ = false;
  SimTime time_{};
  ArmVector angle_ = ArmVector::Zero();
  ArmVector rate_ = ArmVector::Zero();
};

}  // namespace ballbot
