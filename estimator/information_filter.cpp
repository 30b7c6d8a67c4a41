#include "estimator/information_filter.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

constexpr double kDoubtTilt = 10 * kRadPerDeg;  // [rad]
constexpr double kDoubtVelocity = 0.5;          // [m/s]
constexpr double kDoubtOmega = 1.0;             // [rad/s]
constexpr double kDoubtSpin = 1.0;              // [rad/s]

}  // namespace

template <int kDim>
BasicInformationFilter<kDim>::BasicInformationFilter(const RobotParameters& robot,
                                                     const FilterNoise& noise,
                                                     const GateSettings& gate,
                                                     double accel_bias_sigma, int iterations,
                                                     const SpinSettings& spin)
    : model_(robot, noise),
      gate_settings_(gate),
      accel_bias_sigma_(accel_bias_sigma),
      iterations_(iterations),
      gate_(gate),
      spin_gate_(spin) {}

template <int kDim>
void BasicInformationFilter<kDim>::initialise(const FilterState& x,
                                              const Matrix& information) noexcept {
  x_ = x;
  setInformation(information);
  smooth_velocity_.jumpTo(x.v_WK_W);
  accel_W_.setZero();
  gate_.forget();
  spin_gate_.forget();
}

template <int kDim>
void BasicInformationFilter<kDim>::step(const IntervalMeasurement& measured,
                                        RejectionCounts& counts) noexcept {
  IntervalMeasurement m = measured;
  m.smooth_v_old_W = smooth_velocity_.value();
  smooth_velocity_.advance(x_.v_WK_W, m.h);
  m.smooth_v_new_W = smooth_velocity_.value();
  // Two wheels cannot tell a spin from a ball that rolls another way: then it is held.
  if (kSpins && gate_.anyStuck()) spin_gate_.forget();
  if constexpr (kSpins) spin_gate_.expect(x_.spin, m);
  std::array<bool, kWheelCount> use = gate_.usable(m.has_wheel);
  FilterState next = model_.predict(x_, m);

  bool solved = solveWithoutOutliers(m, next, use, counts);
  for (int i = 1; solved && i < iterations_; ++i) {
    next = next.plus(update_.delta());
    model_.evaluate(x_, next, m, residuals_);
    solved = update_.solve(information_, residuals_, use);
  }
  if (!solved) {
    counts.add(Rejection::kUpdateFailed);
    x_ = model_.predict(x_, m);
    doubt();
    return;
  }
  next = next.plus(update_.delta());
  accel_W_ = (next.v_WK_W - x_.v_WK_W) / m.h;
  x_ = next;
  information_ = update_.information();
  covariance_root_ = update_.covarianceRoot();
  if constexpr (kSpins) spin_gate_.follow(x_.spin);
  nis_ = update_.chiSquare();
  nis_degrees_ = static_cast<int>(std::count(use.begin(), use.end(), true)) + (m.has_accel ? 1 : 0);

  if (gate_.doubtsState()) {
    counts.add(Rejection::kStateDoubted);
    doubt();
  }
}

template <int kDim>
bool BasicInformationFilter<kDim>::solveWithoutOutliers(IntervalMeasurement& m, FilterState& next,
                                                        std::array<bool, kWheelCount>& use,
                                                        RejectionCounts& counts) noexcept {
  model_.evaluate(x_, next, m, residuals_);
  if (!update_.solve(information_, residuals_, use)) return false;
  if (!refuseOutliers(m, next, use)) return false;
  if (m.has_accel && update_.chiSquare() > gate_settings_.chi_square_limit) {
    counts.add(Rejection::kAccelInconsistent);
    m.has_accel = false;
    next = model_.predict(x_, m);
    model_.evaluate(x_, next, m, residuals_);
    if (!update_.solve(information_, residuals_, use)) return false;
  }
  gate_.settle(update_.standardizedWheels(), m, use, counts);
  return true;
}

/// One after the other, always what explains the most of what does not fit: a wheel that is off
/// alone, or all of them by a spin that nobody expected.
template <int kDim>
bool BasicInformationFilter<kDim>::refuseOutliers(IntervalMeasurement& m, const FilterState& next,
                                                  std::array<bool, kWheelCount>& use) noexcept {
  bool jumped = false;
  for (;;) {
    const Vector3 off = update_.standardizedWheels();
    const int wheel = gate_.worstOutlier(off, use);
    if constexpr (kSpins) {
      if (!jumped && !gate_.anyStuck() && spin_gate_.jumps(commonPart(), off, use)) {
        jumped = true;
        SpinGate::expectAnything(m);
        model_.evaluate(x_, next, m, residuals_);
        if (!update_.solve(information_, residuals_, use)) return false;
        continue;
      }
    }
    if (wheel < 0) break;
    use[static_cast<std::size_t>(wheel)] = false;
    if (!update_.solve(information_, residuals_, use)) return false;
  }
  if constexpr (kSpins) spin_gate_.settle(use, jumped, commonPart(), gate_.largestMean(use));
  return true;
}

/// Of the wheels' residuals, what a spin beyond the expected would shift [standard deviations].
template <int kDim>
double BasicInformationFilter<kDim>::commonPart() const noexcept {
  return update_.standardizedShift(residuals_.d_new.block<3, 1>(kRowWheels, kTanSpin));
}

template <int kDim>
void BasicInformationFilter<kDim>::doubt() noexcept {
  gate_.forget();
  spin_gate_.forget();
  // The bias has taken in part of what was wrong with the tilt.
  x_.accel_bias.setZero();
  Matrix P = covariance();
  P.template middleRows<3>(kTanAccelBias).setZero();
  P.template middleCols<3>(kTanAccelBias).setZero();
  P.diagonal()
      .template segment<3>(kTanAccelBias)
      .setConstant(accel_bias_sigma_ * accel_bias_sigma_);
  const Vector3 up_B = x_.R_WB.transpose() * Vector3::UnitZ();
  P.template block<3, 3>(kTanAttitude, kTanAttitude) +=
      kDoubtTilt * kDoubtTilt * (Matrix3::Identity() - up_B * up_B.transpose());
  P.diagonal().template segment<2>(kTanVelocity).array() += kDoubtVelocity * kDoubtVelocity;
  P.diagonal().template segment<3>(kTanOmega).array() += kDoubtOmega * kDoubtOmega;
  if constexpr (kSpins) P(kTanSpin, kTanSpin) += kDoubtSpin * kDoubtSpin;
  setInformation(inverseSpd(P));
}

template <int kDim>
void BasicInformationFilter<kDim>::addRows(const Eigen::Matrix<double, 3, kTangentDim>& H,
                                           const Vector3& y) noexcept {
  Matrix information = information_;
  information.template topLeftCorner<kTangentDim, kTangentDim>() += H.transpose().lazyProduct(H);
  Vector gradient = Vector::Zero();
  gradient.template head<kTangentDim>() = H.transpose() * y;
  const Vector delta = -(inverseSpd(information) * gradient);
  x_ = x_.plus(delta);
  setInformation(information);
}

template <int kDim>
void BasicInformationFilter<kDim>::turn(double angle) noexcept {
  const Eigen::Matrix2d Rz = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Matrix P = covariance();
  // A small yaw error d moves the position by slope d = z x (p - pivot) d.
  const Vector3 up_B = x_.R_WB.transpose() * Vector3::UnitZ();
  const Vector3 yaw_covariance = P.template block<3, 3>(kTanAttitude, kTanAttitude) * up_B;
  const Eigen::Vector2d slope =
      P.template block<2, 3>(kTanPosition, kTanAttitude) * up_B / up_B.dot(yaw_covariance);
  const Eigen::Vector2d from_pivot(slope.y(), -slope.x());
  x_.p_WK_W += Rz * from_pivot - from_pivot;
  x_.R_WB = rotationFromYawPitchRoll(angle, 0, 0) * x_.R_WB;
  x_.v_WK_W = Rz * x_.v_WK_W;
  smooth_velocity_.turn(Rz);
  accel_W_ = Rz * accel_W_;
  // Errors of attitude, rates and biases are expressed in B and do not notice.
  for (const int at : {kTanPosition, kTanVelocity}) {
    P.template middleRows<2>(at) = (Rz * P.template middleRows<2>(at)).eval();
    P.template middleCols<2>(at) = (P.template middleCols<2>(at) * Rz.transpose()).eval();
  }
  setInformation(inverseSpd(P));
}

template <int kDim>
void BasicInformationFilter<kDim>::relax(const TangentMatrix& extra_covariance) noexcept {
  Matrix P = covariance();
  P.template topLeftCorner<kTangentDim, kTangentDim>() += extra_covariance;
  setInformation(inverseSpd(P));
}

template <int kDim>
void BasicInformationFilter<kDim>::setInformation(const Matrix& information) noexcept {
  information_ = information;
  covariance_root_ = inverseRoot(information);
}

template <int kDim>
BasicTangentMatrix<kDim> BasicInformationFilter<kDim>::covariance() const noexcept {
  return covariance_root_ * covariance_root_.transpose();
}

template class BasicInformationFilter<kTangentDim>;
template class BasicInformationFilter<kSpinTangentDim>;

}  // namespace ballbot
