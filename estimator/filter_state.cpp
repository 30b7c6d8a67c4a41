#include "estimator/filter_state.hpp"

#include "estimator/attitude.hpp"
#include "model/frames.hpp"

namespace ballbot {

FilterState FilterState::plus(const TangentVector& delta) const noexcept {
  FilterState next;
  next.p_WK_W = p_WK_W + delta.segment<2>(kTanPosition);
  next.R_WB = orthonormalized(R_WB * expSO3(delta.segment<3>(kTanAttitude)));
  next.v_WK_W = v_WK_W + delta.segment<2>(kTanVelocity);
  next.w_WB_B = w_WB_B + delta.segment<3>(kTanOmega);
  next.accel_bias = accel_bias + delta.segment<3>(kTanAccelBias);
  next.gyro_bias = gyro_bias + delta.segment<3>(kTanGyroBias);
  return next;
}

TangentVector FilterState::minus(const FilterState& from) const noexcept {
  TangentVector delta;
  delta << p_WK_W - from.p_WK_W, logSO3(from.R_WB.transpose() * R_WB), v_WK_W - from.v_WK_W,
      w_WB_B - from.w_WB_B, accel_bias - from.accel_bias, gyro_bias - from.gyro_bias;
  return delta;
}

}  // namespace ballbot
