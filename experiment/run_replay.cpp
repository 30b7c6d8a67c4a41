#include "experiment/run_replay.hpp"

#include <Eigen/Geometry>

#include "model/body_poses.hpp"
#include "model/frames.hpp"
#include "model/omniwheel_kinematics.hpp"

namespace ballbot {
namespace {

ReplayPose pose(const Vector3& p_W, const Eigen::Quaterniond& q) {
  return {{p_W.x(), p_W.y(), p_W.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

/// The point that a push acts on, in W.
Vector3 pushPoint(const Push& push, const Vector3& p_WK,
                  const std::array<BodyPose, 1 + kArmJointCount>& poses) {
  if (push.body == kBallBody) return p_WK + push.p_BP_B;
  const BodyPose& body = poses[push.body - kBaseBody];
  return body.p_WL + body.R_WL * push.p_BP_B;
}

/// What is asked of the end-effector, in W.
ReplayPose askedPose(const EeReference& reference, SimTime t) {
  const PoseVector asked = reference.at(t);
  const Matrix3 R_HE = rotationFromYawPitchRoll(asked[3], asked[4], asked[5]);
  return pose(reference.home.pointInW(asked.head<3>()),
              Eigen::Quaterniond(reference.home.R_WH() * R_HE));
}

}  // namespace

ReportReplay makeReplay(const RunLog& log, const RobotParameters& robot,
                        const std::vector<Push>& pushes, const EeReference& reference) {
  ReportReplay replay;
  ReplayBody base{"base", {}}, ball{"ball", {}};
  ReplayFrame hand{"end-effector", SeriesStyle::kMeasured, {}};
  ReplayFrame asked{"end-effector reference", SeriesStyle::kReference, {}};
  ReplayForce contact{"contact", ReportPhase::Kind::kContact, {}, {}};
  std::vector<ReplayForce> push_forces(pushes.size(), {"push", ReportPhase::Kind::kPush, {}, {}});
  // Joint names as the URDF has them, in the order of the actuators.
  for (const char* name : {"wheel_1_joint", "wheel_2_joint", "wheel_3_joint", "arm_1_joint", "arm_2_joint", "arm_3_joint"}) {
    replay.joints.push_back({name, {}});
  }
  Eigen::Quaterniond ball_orientation = Eigen::Quaterniond::Identity();
  bool touched = false;
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
    const SimTime time = simTimeFromNs(m.sim_time_ns);
    asked.poses.push_back(askedPose(reference, time));
    StateVector x;
    x << Eigen::Map<const PositionVector>(m.q), Eigen::Map<const VelocityVector>(m.nu);
    const auto bodies = bodyPoses(robot, x);
    for (std::size_t i = 0; i < pushes.size(); ++i) {
      const Vector3 p_WP = pushPoint(pushes[i], p_WK, bodies);
      const Vector3 force = pushes[i].activeAt(time) ? pushes[i].force_W : Vector3::Zero();
      push_forces[i].point_W.push_back({p_WP.x(), p_WP.y(), p_WP.z()});
      push_forces[i].force_W.push_back({force.x(), force.y(), force.z()});
    }
    contact.point_W.push_back({m.contact_point_W[0], m.contact_point_W[1], m.contact_point_W[2]});
    contact.force_W.push_back({m.contact_force_W[0], m.contact_force_W[1], m.contact_force_W[2]});
    touched = touched || m.contact_phase != 0;
  }
  replay.bodies = {std::move(base), std::move(ball)};
  replay.frames = {std::move(hand)};
  if (reference.moves()) replay.frames.push_back(std::move(asked));
  replay.forces = std::move(push_forces);
  if (touched) replay.forces.push_back(std::move(contact));
  return replay;
}

}  // namespace ballbot
