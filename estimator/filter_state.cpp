#include "estimator/filter_state.hpp"

#include "estimator/attitude.hpp"
#include "model/frames.hpp"

namespace ballbot {

template <int kDim>
FilterState FilterState::plus(const Eigen::Matrix<double, kDim, 1>& delta) const noexcept {
  FilterState next;
  next.p_WK_W = p_WK_W + delta.template segment<2>(kTanPosition);
  next.R_WB = orthonormalized(R_WB * expSO3(delta.template segment<3>(kTanAttitude)));
  next.v_WK_W = v_WK_W + delta.template segment<2>(kTanVelocity);
  next.w_WB_B = w_WB_B + delta.template segment<3>(kTanOmega);
  next.accel_bias = accel_bias + delta.template segment<3>(kTanAccelBias);
  next.gyro_bias = gyro_bias + delta.template segment<3>(kTanGyroBias);
  next.spin = spin;
  if constexpr (kDim > kTanSpin) next.spin += delta[kTanSpin];
  return next;
}

template <int kDim>
BasicTangentVector<kDim> FilterState::minus(const FilterState& from) const noexcept {
  BasicTangentVector<kDim> delta;
  delta.template head<kTangentDim>() << p_WK_W - from.p_WK_W, logSO3(from.R_WB.transpose() * R_WB),
      v_WK_W - from.v_WK_W, w_WB_B - from.w_WB_B, accel_bias - from.accel_bias,
      gyro_bias - from.gyro_bias;
  if constexpr (kDim > kTanSpin) delta[kTanSpin] = spin - from.spin;
  return delta;
}

template FilterState FilterState::plus<kTangentDim>(const TangentVector&) const noexcept;
template FilterState FilterState::plus<kSpinTangentDim>(
    const BasicTangentVector<kSpinTangentDim>&) const noexcept;
template TangentVector FilterState::minus<kTangentDim>(const FilterState&) const noexcept;
template BasicTangentVector<kSpinTangentDim> FilterState::minus<kSpinTangentDim>(
    const FilterState&) const noexcept;

}  // namespace ballbot
