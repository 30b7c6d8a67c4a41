#include "estimator/pose_aiding.hpp"

#include <cmath>

#include "estimator/attitude.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

/// A larger correction of yaw is taken as an exact turn. Taken as a linear step it would carry
/// velocity and tilt along by their correlations with yaw, which hold for small angles [rad].
constexpr double kLinearYaw = 0.05;

/// A pose tells nothing about the spin.
template <int kDim>
TangentMatrix withoutSpin(const Eigen::Matrix<double, kDim, kDim>& covariance) {
  return covariance.template topLeftCorner<kTangentDim, kTangentDim>();
}

}  // namespace

void PoseAiding::takeAtRest(const Vector3& pose_W, RejectionCounts& counts) noexcept {
  if (!pose_W.allFinite()) {
    counts.add(Rejection::kNotFinite);
  } else if (!rest_.add(pose_W, settings_)) {
    counts.add(Rejection::kPoseOutlier);
  }
}

void PoseAiding::tell(SimTime time, const FilterState& x, double yaw) noexcept {
  history_.add({time, x.p_WK_W, yaw});
}

template <int kDim>
void PoseAiding::take(const SensorFrame& frame, SimTime time, BasicInformationFilter<kDim>& filter,
                      double& yaw, RejectionCounts& counts) noexcept {
  if (!frame.pose_W.allFinite()) {
    counts.add(Rejection::kNotFinite);
    return;
  }
  const auto rowsNow = [&]() -> std::optional<PoseRows> {
    const std::optional<PoseHistory::Entry> then = history_.at(frame.pose_time);
    if (!then) return std::nullopt;
    const PoseHistory::Entry now{time, filter.state().p_WK_W, yaw};
    return poseRows(filter.state(), *then, now, frame.pose_W, settings_);
  };
  std::optional<PoseRows> rows = rowsNow();
  if (!rows) {
    counts.add(Rejection::kPoseLate);
    return;
  }
  if (rest_.samples() == 0 && !heading_known_) bringInTheHeading(filter);
  heading_known_ = true;
  if (!believes(*rows, filter, counts)) return;

  const double turn = rows->yawCorrection(withoutSpin(filter.covariance()), settings_);
  if (std::abs(turn) > kLinearYaw) {
    filter.turn(turn);
    yaw += turn;
    history_.moveTo({time, filter.state().p_WK_W, yaw});
    rows = rowsNow();
    rows->y[2] = 0;  // that is where pose and past agree about yaw
  }
  filter.addRows(rows->H, rows->y);
  yaw = unwrapped(yawPitchRollFromRotation(filter.state().R_WB)[0], yaw);
  history_.moveTo({time, filter.state().p_WK_W, yaw});
}

template <int kDim>
void PoseAiding::bringInTheHeading(BasicInformationFilter<kDim>& filter) noexcept {
  // A robot placed with another yaw has turned about the place of its release, px = py = 0.
  const FilterState& x = filter.state();
  TangentVector turn = TangentVector::Zero();
  turn.segment<2>(kTanPosition) << -x.p_WK_W.y(), x.p_WK_W.x();
  turn.segment<3>(kTanAttitude) = x.R_WB.transpose() * Vector3::UnitZ();
  turn.segment<2>(kTanVelocity) << -x.v_WK_W.y(), x.v_WK_W.x();
  filter.relax(yaw_sigma_ * yaw_sigma_ * turn * turn.transpose());
}

template <int kDim>
bool PoseAiding::believes(const PoseRows& rows, BasicInformationFilter<kDim>& filter,
                          RejectionCounts& counts) noexcept {
  if (rows.chiSquare(withoutSpin(filter.covariance())) > settings_.chi_square_limit) {
    counts.add(Rejection::kPoseOutlier);
    if (++refused_ < kPosesUntilBelieved) return false;
    // So many are against it: the estimate has drifted away further than it knows.
    const Vector3 up_B = filter.state().R_WB.transpose() * Vector3::UnitZ();
    TangentMatrix doubt = TangentMatrix::Zero();
    doubt.diagonal().segment<2>(kTanPosition).setConstant(1.0);
    doubt.block<3, 3>(kTanAttitude, kTanAttitude) = up_B * up_B.transpose();
    filter.relax(doubt);
  }
  refused_ = 0;
  return true;
}

template void PoseAiding::take(const SensorFrame&, SimTime, BasicInformationFilter<kTangentDim>&,
                               double&, RejectionCounts&) noexcept;
template void PoseAiding::take(const SensorFrame&, SimTime,
                               BasicInformationFilter<kSpinTangentDim>&, double&,
                               RejectionCounts&) noexcept;

}  // namespace ballbot
