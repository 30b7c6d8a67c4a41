#include "model/dynamics_constants.hpp"

namespace ballbot {
namespace {

/// Sum of m p p^T about the centre of mass, from the inertia there.
Matrix3 secondMoment(const Matrix3& inertia) {
  return 0.5 * inertia.trace() * Matrix3::Identity() - inertia;
}

}  // namespace

DynamicsConstants::DynamicsConstants(const RobotParameters& robot) {
  rigid_arm = true;
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = robot.arm[i];
    const BodyInertia body = i == kArmJointCount - 1 ? robot.lastLinkWithPayload() : link.inertia;
    arm[i] = {link.p_PJ_P,
              link.slides() ? link.slide() : link.axis,
              link.slides(),
              body.p_LLcm_L,
              secondMoment(body.I_LLcm_L),
              body.mass};
    rigid_arm = rigid_arm && body.mass == 0 && body.I_LLcm_L.isZero(0);
  }
  p_A3E = robot.p_A3E;
  R_A3E = robot.R_A3E;

  const BodyInertia base = robot.baseWithWheels();
  base_mass = base.mass;
  base_first_moment = base.mass * base.p_LLcm_L;
  base_second_moment =
      secondMoment(base.I_LLcm_L) + base.mass * base.p_LLcm_L * base.p_LLcm_L.transpose();

  gravity = robot.gravity;
  ball_radius = robot.ball.radius;
  total_mass = robot.totalMass();
  rolling_mass = robot.ball.mass + robot.ball.inertia / (ball_radius * ball_radius);
  ratio = robot.ball.radius / robot.wheels.radius;
  for (int i = 0; i < kWheelCount; ++i) axles.row(i) = robot.wheelAxle(i).transpose();
  spin_inertia = robot.wheels.spin_inertia * axles.transpose() * axles;
  ball_inertia = robot.ball.inertia;
}

}  // namespace ballbot
