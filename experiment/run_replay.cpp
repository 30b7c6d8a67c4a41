#include "experiment/run_replay.hpp"

#include <Eigen/Geometry>

#include "model/frames.hpp"
#include "model/omniwheel_kinematics.hpp"

namespace ballbot {
namespace {

ReplayPose pose(const Vector3& p_W, const Eigen::Quaterniond& q) {
  return {{p_W.x(), p_W.y(), p_W.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

/// Where the push that acts at `t` acts on the base, in B; pushes on other bodies are drawn there too.
Vector3 pushPoint(const std::vector<Push>& pushes, SimTime t) {
  for (const Push& push : pushes) {
    if (push.activeAt(t)) return push.p_BP_B;
  }
  return Vector3::Zero();
}

}  // namespace

ReportReplay makeReplay(const RunLog& log, const RobotParameters& robot,
                        const std::vector<Push>& pushes) {
  ReportReplay replay;
  ReplayBody base{"base", {}}, ball{"ball", {}};
  ReplayFrame hand{"end-effector", SeriesStyle::kMeasured, {}};
  ReplayForce push{"push", ReportPhase::Kind::kPush, {}, {}}, contact{"contact", ReportPhase::Kind::kContact, {}, {}};
  // Joint names as the URDF has them, in the order of the actuators.
  for (const char* name : {"wheel_1_joint", "wheel_2_joint", "wheel_3_joint", "arm_1_joint", "arm_2_joint", "arm_3_joint"}) {
    replay.joints.push_back({name, {}});
  }
  Eigen::Quaterniond ball_orientation = Eigen::Quaterniond::Identity();
  bool pushed = false, touched = false;
  for (std::size_t k = 0; k < log.truth.size(); ++k) {
    const auto& m = log.truth[k];
    const double t = 1e-9 * static_cast<double>(m.sim_time_ns);
    if (k > 0) {
      // The ball's orientation is no state of the plant: it follows from rolling without spin.
      const double dt = t - replay.t.back();
      const Vector3 w = OmniwheelKinematics::rollingAngularVelocity(m.nu[0], m.nu[1], robot.ball.radius);
      ball_orientation = (Eigen::Quaterniond(expSO3(w * dt)) * ball_orientation).normalized();
    }
    const Vector3 p_WK(m.q[0], m.q[1], robot.ball.radius);
    const Matrix3 R_WB = rotationFromYawPitchRoll(m.q[2], m.q[3], m.q[4]);
    replay.t.push_back(t);
    base.poses.push_back(pose(p_WK, Eigen::Quaterniond(R_WB)));
    ball.poses.push_back(pose(p_WK, ball_orientation));
    for (std::size_t j = 0; j < replay.joints.size(); ++j) replay.joints[j].angle.push_back(m.joint_angle[j]);
    hand.poses.push_back({{m.p_WE[0], m.p_WE[1], m.p_WE[2]},
                          {m.quat_WE[0], m.quat_WE[1], m.quat_WE[2], m.quat_WE[3]}});
    const Vector3 p_WP = p_WK + R_WB * pushPoint(pushes, simTimeFromNs(m.sim_time_ns));
    push.point_W.push_back({p_WP.x(), p_WP.y(), p_WP.z()});
    push.force_W.push_back({m.external_force_W[0], m.external_force_W[1], m.external_force_W[2]});
    contact.point_W.push_back(hand.poses.back().p_W);
    contact.force_W.push_back({m.contact_force_W[0], m.contact_force_W[1], m.contact_force_W[2]});
    for (int i = 0; i < 3; ++i) {
      pushed = pushed || m.external_force_W[i] != 0;
      touched = touched || m.contact_force_W[i] != 0;
    }
  }
  replay.bodies = {std::move(base), std::move(ball)};
  replay.frames = {std::move(hand)};
  if (pushed) replay.forces.push_back(std::move(push));
  if (touched) replay.forces.push_back(std::move(contact));
  return replay;
}

}  // namespace ballbot
