#include "estimator/external_pose.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "estimator/attitude.hpp"
#include "model/frames.hpp"

namespace ballbot {

void ExternalPoseSettings::describe(ConfigVisitor& v) {
  v.number(may("position_sigma_m", "standard deviation of the position"), position_sigma_m,
           {1e-5, 10});
  v.number(may("yaw_sigma_deg", "standard deviation of the yaw"), yaw_sigma_rad, {1e-3, 180},
           kRadPerDeg);
  v.number(may("chi_square_limit", "above it a pose is refused, until ten in a row were"),
           chi_square_limit, {5, 1e12});
}

bool RestPose::add(const Vector3& pose_W, const ExternalPoseSettings& settings) noexcept {
  Vector3 pose = pose_W;
  if (samples_ > 0) {
    pose[2] = unwrapped(pose[2], mean_[2]);
    const double n = static_cast<double>(samples_);
    const Vector3 sigma(settings.position_sigma_m, settings.position_sigma_m,
                        settings.yaw_sigma_rad);
    const double chi_square =
        (pose - mean_).cwiseQuotient(std::sqrt(1 + 1 / n) * sigma).squaredNorm();
    if (chi_square > settings.chi_square_limit) {
      if (++refused_ < kPosesUntilBelieved) return false;
      samples_ = 0;
    }
  }
  refused_ = 0;
  ++samples_;
  mean_ = samples_ == 1 ? pose : Vector3(mean_ + (pose - mean_) / static_cast<double>(samples_));
  return true;
}

Vector3 RestPose::mean() const noexcept { return {mean_[0], mean_[1], unwrapped(mean_[2], 0.0)}; }

std::optional<PoseHistory::Entry> PoseHistory::at(SimTime time) const noexcept {
  if (entries_.empty() || time > entries_.fromNewest(0).time) return std::nullopt;
  if (time == entries_.fromNewest(0).time) return entries_.fromNewest(0);
  for (int age = 1; age < entries_.size(); ++age) {
    const Entry& before = entries_.fromNewest(age);
    if (before.time > time) continue;
    const Entry& after = entries_.fromNewest(age - 1);
    const double fraction = toSeconds(time - before.time) / toSeconds(after.time - before.time);
    return Entry{time, before.p_WK_W + fraction * (after.p_WK_W - before.p_WK_W),
                 before.yaw + fraction * (after.yaw - before.yaw)};
  }
  return std::nullopt;
}

void PoseHistory::moveTo(const Entry& now) noexcept {
  const Entry old = entries_.fromNewest(0);
  const Eigen::Rotation2Dd turn(now.yaw - old.yaw);
  for (int age = 0; age < entries_.size(); ++age) {
    Entry& entry = entries_.fromNewest(age);
    entry.p_WK_W = now.p_WK_W + turn * (entry.p_WK_W - old.p_WK_W);
    entry.yaw += now.yaw - old.yaw;
  }
}

double PoseRows::chiSquare(const TangentMatrix& covariance) const noexcept {
  const Matrix3 S = H * covariance * H.transpose() + Matrix3::Identity();
  return y.dot(Vector3(Eigen::LLT<Matrix3>(S).solve(y)));
}

double PoseRows::yawCorrection(const TangentMatrix& covariance,
                               const ExternalPoseSettings& settings) const noexcept {
  const double variance = H.row(2) * covariance * H.row(2).transpose();
  return -variance / (variance + 1) * settings.yaw_sigma_rad * y[2];
}

PoseRows poseRows(const FilterState& x, const PoseHistory::Entry& then,
                  const PoseHistory::Entry& now, const Vector3& pose_W,
                  const ExternalPoseSettings& settings) noexcept {
  const double sp = 1 / settings.position_sigma_m, sy = 1 / settings.yaw_sigma_rad;
  const Eigen::Vector2d covered = now.p_WK_W - then.p_WK_W;
  const double yaw_change = now.yaw - then.yaw;
  const Vector3 ypr = yawPitchRollFromRotation(x.R_WB);
  const Eigen::RowVector3d yaw_by_attitude = eulerRateMatrix(ypr[1], ypr[2]).row(0);

  PoseRows rows;
  rows.y << sp * (x.p_WK_W - covered - pose_W.head<2>()),
      sy * unwrapped(now.yaw - yaw_change - pose_W[2], 0.0);
  rows.H.block<2, 2>(0, kTanPosition).diagonal().setConstant(sp);
  // A yaw error d turns what was covered by z x covered d.
  rows.H.block<1, 3>(0, kTanAttitude) = sp * covered.y() * yaw_by_attitude;
  rows.H.block<1, 3>(1, kTanAttitude) = -sp * covered.x() * yaw_by_attitude;
  rows.H.block<1, 3>(2, kTanAttitude) = sy * yaw_by_attitude;
  return rows;
}

}  // namespace ballbot
