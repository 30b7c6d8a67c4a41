#include "controller/wheel_grip.hpp"

#include <cmath>

namespace ballbot {

void WheelGrip::update(SimTime now, const Vector3& torque, const Vector3& velocity) noexcept {
  if (!torque.allFinite() || !velocity.allFinite()) return;
  const double share = last_ == SimTime{} ? 1 : -std::expm1(-toSeconds(now - last_) / kWindow);
  last_ = now;
  latest_ = velocity;
  torque_ += share * (torque - torque_);
  velocity_ += share * (velocity - velocity_);
}

}  // namespace ballbot
