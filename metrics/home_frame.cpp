#include "metrics/home_frame.hpp"

#include <Eigen/Geometry>

namespace ballbot {

TruthFrame HomeFrame::see(const TruthFrame& truth_W) const {
  const Eigen::Rotation2Dd to_home(-yaw);
  const Matrix3 R_HW = R_WH().transpose();
  const Eigen::Quaterniond quat_HW(Eigen::AngleAxisd(-yaw, Vector3::UnitZ()));
  const Vector3 p_WH3(p_WH.x(), p_WH.y(), 0);
  TruthFrame out = truth_W;
  out.state.segment<2>(kBallX) = to_home * (truth_W.state.segment<2>(kBallX) - p_WH);
  out.state.segment<2>(kPositionDim + kBallVx) =
      to_home * truth_W.state.segment<2>(kPositionDim + kBallVx);
  out.state[kYaw] -= yaw;
  out.p_WE = R_HW * (truth_W.p_WE - p_WH3);
  const Eigen::Vector4d& q = truth_W.quat_WE;
  const Eigen::Quaterniond quat_HE = quat_HW * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  out.quat_WE << quat_HE.w(), quat_HE.x(), quat_HE.y(), quat_HE.z();
  out.external_force_W = R_HW * truth_W.external_force_W;
  out.contact_force_W = R_HW * truth_W.contact_force_W;
  out.contact_point_W = R_HW * (truth_W.contact_point_W - p_WH3);
  return out;
}

Vector3 HomeFrame::pointInW(const Vector3& p_H) const {
  return R_WH() * p_H + Vector3(p_WH.x(), p_WH.y(), 0);
}

Matrix3 HomeFrame::R_WH() const {
  return Eigen::AngleAxisd(yaw, Vector3::UnitZ()).toRotationMatrix();
}

}  // namespace ballbot
