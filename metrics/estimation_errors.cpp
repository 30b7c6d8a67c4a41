#include "metrics/estimation_errors.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

/// Drift in percent of less than this says nothing [m].
constexpr double kDistanceWorthDividingBy = 0.1;

Matrix3 attitude(const StateVector& x) {
  return rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
}

}  // namespace

void EstimationErrors::add(const TruthFrame& truth, const StateVector& estimate) {
  if (truth.time < release_) return;
  const StateVector& x_true = truth.state;
  if (!started_) {
    started_ = true;
    last_ = truth.time;
    last_position_ = x_true.segment<2>(kBallX);
  }
  // The rotation about horizontal axes that takes the estimated vertical to the true one.
  const Matrix3 R_estimate = attitude(estimate);
  const Vector3 up_true_W = R_estimate * (attitude(x_true).transpose() * Vector3::UnitZ());
  error_.tilt_W << up_true_W.y(), -up_true_W.x();
  const double tilt = std::atan2(error_.tilt_W.norm(), up_true_W.z());
  error_.velocity_W =
      x_true.segment<2>(kPositionDim + kBallVx) - estimate.segment<2>(kPositionDim + kBallVx);

  const double dt = toSeconds(truth.time - last_);
  observed_s_ += dt;
  tilt2_integral_ += dt * tilt * tilt;
  velocity2_integral_ += dt * error_.velocity_W.squaredNorm();
  largest_tilt_ = std::max(largest_tilt_, tilt);
  error_.yaw = std::remainder(x_true[kYaw] - estimate[kYaw], 2 * kPi);
  error_.position_W = x_true.segment<2>(kBallX) - estimate.segment<2>(kBallX);
  distance_ += (x_true.segment<2>(kBallX) - last_position_).norm();
  last_position_ = x_true.segment<2>(kBallX);
  last_ = truth.time;
}

void EstimationErrors::addConsistency(const SelfAssessment& assessment) {
  if (!started_ || assessment.time != last_) return;
  Eigen::Vector4d e;
  e << error_.tilt_W, error_.velocity_W;
  nees_sum_ += e.dot(Eigen::Vector4d(assessment.tilt_velocity_covariance.llt().solve(e)));
  nis_sum_ += assessment.nis;
  nis_degrees_sum_ += assessment.nis_degrees;
  ++consistency_samples_;
}

std::map<std::string, double> EstimationErrors::values() const {
  std::map<std::string, double> out;
  if (observed_s_ > 0) {
    out["tilt_rms_deg"] = std::sqrt(tilt2_integral_ / observed_s_) / kRadPerDeg;
    out["largest_tilt_error_deg"] = largest_tilt_ / kRadPerDeg;
    out["velocity_rms_m_per_s"] = std::sqrt(velocity2_integral_ / observed_s_);
    out["yaw_error_deg"] = std::abs(error_.yaw) / kRadPerDeg;
    out["position_error_m"] = error_.position_W.norm();
  }
  if (distance_ > kDistanceWorthDividingBy) {
    out["position_drift_percent"] = 100 * error_.position_W.norm() / distance_;
  }
  if (consistency_samples_ > 0) {
    out["nees_mean"] = nees_sum_ / consistency_samples_;
    out["nis_mean"] = nis_sum_ / consistency_samples_;
    out["nis_degrees_mean"] = nis_degrees_sum_ / consistency_samples_;
  }
  return out;
}

std::vector<std::string> EstimationErrors::names() {
  return {"tilt_rms_deg",
          "largest_tilt_error_deg",
          "velocity_rms_m_per_s",
          "yaw_error_deg",
          "position_error_m",
          "position_drift_percent",
          "nees_mean",
          "nis_mean",
          "nis_degrees_mean"};
}

}  // namespace ballbot
