#include "estimator/delay_compensation.hpp"

#include "estimator/attitude.hpp"
#include "model/frames.hpp"

namespace ballbot {

StateVector bringForward(const FilterState& x, const Eigen::Vector2d& accel_W, double yaw,
                         SimDuration ahead) noexcept {
  const double dt = toSeconds(ahead);
  const Vector3 ypr = yawPitchRollFromRotation(x.R_WB * expSO3(dt * x.w_WB_B));
  StateVector out = StateVector::Zero();
  out.segment<2>(kBallX) = x.p_WK_W + dt * x.v_WK_W + 0.5 * dt * dt * accel_W;
  out.segment<3>(kYaw) << unwrapped(ypr[0], yaw), ypr[1], ypr[2];
  out.segment<2>(kPositionDim + kBallVx) = x.v_WK_W + dt * accel_W;
  out.segment<3>(kPositionDim + kOmegaX) = x.w_WB_B;
  return out;
}

}  // namespace ballbot
