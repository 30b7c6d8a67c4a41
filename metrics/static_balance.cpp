#include "metrics/static_balance.hpp"

#include <array>
#include <cmath>

#include "model/body_poses.hpp"
#include "model/frames.hpp"

namespace ballbot {

UpperBody upperBody(const RobotParameters& robot, const StateVector& x) {
  const auto poses = bodyPoses(robot, x);
  std::array<BodyInertia, 1 + kArmJointCount> bodies;
  bodies[0] = robot.baseWithWheels();
  for (int i = 0; i + 1 < kArmJointCount; ++i) bodies[1 + i] = robot.arm[i].inertia;
  bodies.back() = robot.lastLinkWithPayload();
  UpperBody out;
  Vector3 moment = Vector3::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    out.mass += bodies[i].mass;
    moment += bodies[i].mass * (poses[i].p_WL + poses[i].R_WL * bodies[i].p_LLcm_L);
  }
  out.p_WC = moment / out.mass;
  return out;
}

Lean leanOf(const RobotParameters& robot, const TruthFrame& truth, const Vector3& push) {
  const UpperBody body = upperBody(robot, truth.state);
  const Vector3 p_WK(truth.state[kBallX], truth.state[kBallY], robot.ball.radius);
  const double weight = body.mass * robot.gravity;
  const Vector3& F = truth.contact_force_W;
  Lean lean;
  lean.shift = (body.p_WC - p_WK).dot(push);
  lean.normal_shift = -F.dot(push) * truth.p_WE.z() / weight;
  lean.balanced_shift = lean.normal_shift + F.z() * (truth.p_WE - p_WK).dot(push) / weight;
  const Matrix3 R_WB =
      rotationFromYawPitchRoll(truth.state[kYaw], truth.state[kPitch], truth.state[kRoll]);
  lean.angle = std::asin(R_WB.col(2).dot(push));
  return lean;
}

}  // namespace ballbot
