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

void FilterState::save(BlobWriter& out) const {
  out.putDoubles(p_WK_W.data(), 2);
  out.putDoubles(R_WB.data(), 9);
  out.putDoubles(v_WK_W.data(), 2);
  out.putDoubles(w_WB_B.data(), 3);
  out.putDoubles(accel_bias.data(), 3);
  out.putDoubles(gyro_bias.data(), 3);
}

void FilterState::restore(BlobReader& in) {
  in.getDoubles(p_WK_W.data(), 2);
  in.getDoubles(R_WB.data(), 9);
  in.getDoubles(v_WK_W.data(), 2);
  in.getDoubles(w_WB_B.data(), 3);
  in.getDoubles(accel_bias.data(), 3);
  in.getDoubles(gyro_bias.data(), 3);
}

}  // namespace ballbot
