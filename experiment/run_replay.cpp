#include "experiment/run_replay.hpp"

#include <Eigen/Geometry>

#include "experiment/run_config.hpp"
#include "model/body_poses.hpp"
#include "model/frames.hpp"
#include "model/omniwheel_kinematics.hpp"
#include "model/robot_urdf.hpp"

namespace ballbot {
namespace {

std::array<double, 3> listed(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

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
ReplayPose askedPose(const MotionReference& reference, const HomeFrame& home, SimTime t) {
  const PoseVector asked = reference.eePose(t);
  const Matrix3 R_HE = rotationFromYawPitchRoll(asked[3], asked[4], asked[5]);
  return pose(home.pointInW(asked.head<3>()), Eigen::Quaterniond(home.R_WH() * R_HE));
}

}  // namespace

ReplayNames ReplayNames::of(const RunConfig& config) {
  const RobotUrdf urdf = readRobotUrdf(config.scenario.section("robot"));
  return {urdf.links.base, urdf.links.ball, urdf.read.joints};
}

ReportReplay makeReplay(const RunLog& log, const RobotParameters& robot, const ReplayNames& names,
                        const std::vector<Push>& pushes, const MotionReference& reference,
                        const HomeFrame& home) {
  ReportReplay replay;
  replay.followed_link = names.base;
  ReplayBody base{names.base, {}}, ball{names.ball, {}};
  ReplayFrame hand{"end-effector", SeriesStyle::kMeasured, {}};
  ReplayFrame asked{"end-effector reference", SeriesStyle::kReference, {}};
  ReplayForce contact{"contact", ReportPhase::Kind::kContact, {}, {}};
  std::vector<ReplayForce> push_forces(pushes.size(), {"push", ReportPhase::Kind::kPush, {}, {}});
  for (const std::string& name : names.joints) replay.joints.push_back({name, {}});
  Eigen::Quaterniond ball_orientation = Eigen::Quaterniond::Identity();
  bool touched = false;
  for (std::size_t k = 0; k < log.truth.size(); ++k) {
    const TruthFrame& truth = log.truth[k];
    const StateVector& x = truth.state;
    const double t = toSeconds(truth.time);
    if (k > 0) {
      // The ball's orientation is no state of the plant: it follows from rolling without spin.
      const double dt = t - replay.t.back();
      const Vector3 w = OmniwheelKinematics::rollingAngularVelocity(
          x[kPositionDim + kBallVx], x[kPositionDim + kBallVy], robot.ball.radius);
      ball_orientation = (Eigen::Quaterniond(expSO3(w * dt)) * ball_orientation).normalized();
    }
    const Vector3 p_WK(x[kBallX], x[kBallY], robot.ball.radius);
    const Matrix3 R_WB = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
    replay.t.push_back(t);
    base.poses.push_back(pose(p_WK, Eigen::Quaterniond(R_WB)));
    ball.poses.push_back(pose(p_WK, ball_orientation));
    for (std::size_t j = 0; j < replay.joints.size(); ++j) {
      replay.joints[j].angle.push_back(truth.joint_angle[static_cast<Eigen::Index>(j)]);
    };
    const Eigen::Vector4d& q = truth.quat_WE;
    hand.poses.push_back({listed(truth.p_WE), {q[0], q[1], q[2], q[3]}});
    asked.poses.push_back(askedPose(reference, home, truth.time));
    const auto bodies = bodyPoses(robot, x);
    for (std::size_t i = 0; i < pushes.size(); ++i) {
      const Vector3 p_WP = pushPoint(pushes[i], p_WK, bodies);
      const Vector3 force = pushes[i].activeAt(truth.time) ? pushes[i].force_W : Vector3::Zero();
      push_forces[i].point_W.push_back(listed(p_WP));
      push_forces[i].force_W.push_back(listed(force));
    }
    contact.point_W.push_back(listed(truth.contact_point_W));
    contact.force_W.push_back(listed(truth.contact_force_W));
    touched = touched || truth.contact_phase != ContactPhase::kNone;
  }
  replay.bodies = {std::move(base), std::move(ball)};
  replay.frames = {std::move(hand)};
  if (reference.eeMoves()) replay.frames.push_back(std::move(asked));
  replay.forces = std::move(push_forces);
  if (touched) replay.forces.push_back(std::move(contact));
  return replay;
}

}  // namespace ballbot
