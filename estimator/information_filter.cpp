#include "estimator/information_filter.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

constexpr double kDoubtTilt = 10 * kRadPerDeg;  // [rad]
constexpr double kDoubtVelocity = 0.5;          // [m/s]
constexpr double kDoubtOmega = 1.0;             // [rad/s]

}  // namespace

InformationFilter::InformationFilter(const RobotParameters& robot, const FilterNoise& noise,
                                     const GateSettings& gate, double accel_bias_sigma,
                                     int iterations)
    : model_(robot, noise),
      gate_settings_(gate),
      accel_bias_sigma_(accel_bias_sigma),
      iterations_(iterations),
      gate_(gate) {}

void InformationFilter::initialise(const FilterState& x,
                                   const TangentMatrix& information) noexcept {
  x_ = x;
  setInformation(information);
  smooth_velocity_.jumpTo(x.v_WK_W);
  accel_W_.setZero();
  gate_.forget();
}

void InformationFilter::step(const IntervalMeasurement& measured,
                             RejectionCounts& counts) noexcept {
  IntervalMeasurement m = measured;
  m.smooth_v_old_W = smooth_velocity_.value();
  smooth_velocity_.advance(x_.v_WK_W, m.h);
  m.smooth_v_new_W = smooth_velocity_.value();
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
  nis_ = update_.chiSquare();
  nis_degrees_ = static_cast<int>(std::count(use.begin(), use.end(), true)) + (m.has_accel ? 1 : 0);

  if (gate_.doubtsState()) {
    counts.add(Rejection::kStateDoubted);
    doubt();
  }
}

bool InformationFilter::solveWithoutOutliers(IntervalMeasurement& m, FilterState& next,
                                             std::array<bool, kWheelCount>& use,
                                             RejectionCounts& counts) noexcept {
  model_.evaluate(x_, next, m, residuals_);
  if (!update_.solve(information_, residuals_, use)) return false;
  for (int i = gate_.worstOutlier(update_, use); i >= 0; i = gate_.worstOutlier(update_, use)) {
    use[static_cast<std::size_t>(i)] = false;
    if (!update_.solve(information_, residuals_, use)) return false;
  }
  if (m.has_accel && update_.chiSquare() > gate_settings_.chi_square_limit) {
    counts.add(Rejection::kAccelInconsistent);
    m.has_accel = false;
    next = model_.predict(x_, m);
    model_.evaluate(x_, next, m, residuals_);
    if (!update_.solve(information_, residuals_, use)) return false;
  }
  gate_.settle(update_, m, use, counts);
  return true;
}

void InformationFilter::doubt() noexcept {
  gate_.forget();
  // The bias has taken in part of what was wrong with the tilt.
  x_.accel_bias.setZero();
  TangentMatrix P = covariance();
  P.middleRows<3>(kTanAccelBias).setZero();
  P.middleCols<3>(kTanAccelBias).setZero();
  P.diagonal().segment<3>(kTanAccelBias).setConstant(accel_bias_sigma_ * accel_bias_sigma_);
  const Vector3 up_B = x_.R_WB.transpose() * Vector3::UnitZ();
  P.block<3, 3>(kTanAttitude, kTanAttitude) +=
      kDoubtTilt * kDoubtTilt * (Matrix3::Identity() - up_B * up_B.transpose());
  P.diagonal().segment<2>(kTanVelocity).array() += kDoubtVelocity * kDoubtVelocity;
  P.diagonal().segment<3>(kTanOmega).array() += kDoubtOmega * kDoubtOmega;
  setInformation(inverseSpd(P));
}

void InformationFilter::addRows(const Eigen::Matrix<double, 3, kTangentDim>& H,
                                const Vector3& y) noexcept {
  const TangentMatrix information = information_ + H.transpose().lazyProduct(H);
  x_ = x_.plus(-(inverseSpd(information) * (H.transpose() * y)));
  setInformation(information);
}

void InformationFilter::turn(double angle) noexcept {
  const Eigen::Matrix2d Rz = Eigen::Rotation2Dd(angle).toRotationMatrix();
  TangentMatrix P = covariance();
  // A small yaw error d moves the position by slope d = z x (p - pivot) d.
  const Vector3 up_B = x_.R_WB.transpose() * Vector3::UnitZ();
  const Vector3 yaw_covariance = P.block<3, 3>(kTanAttitude, kTanAttitude) * up_B;
  const Eigen::Vector2d slope =
      P.block<2, 3>(kTanPosition, kTanAttitude) * up_B / up_B.dot(yaw_covariance);
  const Eigen::Vector2d from_pivot(slope.y(), -slope.x());
  x_.p_WK_W += Rz * from_pivot - from_pivot;
  x_.R_WB = rotationFromYawPitchRoll(angle, 0, 0) * x_.R_WB;
  x_.v_WK_W = Rz * x_.v_WK_W;
  smooth_velocity_.turn(Rz);
  accel_W_ = Rz * accel_W_;
  // Errors of attitude, rates and biases are expressed in B and do not notice.
  for (const int at : {kTanPosition, kTanVelocity}) {
    P.middleRows<2>(at) = (Rz * P.middleRows<2>(at)).eval();
    P.middleCols<2>(at) = (P.middleCols<2>(at) * Rz.transpose()).eval();
  }
  setInformation(inverseSpd(P));
}

void InformationFilter::relax(const TangentMatrix& extra_covariance) noexcept {
  setInformation(inverseSpd(covariance() + extra_covariance));
}

void InformationFilter::setInformation(const TangentMatrix& information) noexcept {
  information_ = information;
  covariance_root_ = inverseRoot(information);
}

TangentMatrix InformationFilter::covariance() const noexcept {
  return covariance_root_ * covariance_root_.transpose();
}

}  // namespace ballbot
