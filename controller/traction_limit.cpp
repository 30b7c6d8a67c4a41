#include "controller/traction_limit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "model/frames.hpp"

namespace ballbot {
namespace {

// Of what friction holds at rest; torques below it ask no wheel for too much while the robot does
// not fall off its ball.
constexpr double kIdleShare = 0.1;
// Of the normal force at rest, below which a wheel may slip at any time.
constexpr double kUnloadedShare = 0.3;
// Of what friction could give; less than it, and there is less of it.
constexpr double kGripShare = 0.5;

/// `wanted` within `low` and `high`, what wheels at their limits lack made up for by the others as
/// far as they can: the moment on the ball across the vertical `up_B` stays, about it is free up to
/// `spin_torque`.
Vector3 redistributed(const OmniwheelKinematics& kinematics, const Vector3& up_B,
                      double spin_torque, const Vector3& wanted, const Vector3& low,
                      const Vector3& high) {
  // Torques that turn the ball about the vertical and nothing else.
  const Vector3 turn = kinematics.wheelTorques(up_B);
  Vector3 torque = wanted;
  // Along `turn` there is an interval that keeps each wheel's limits; the point of all nearest to
  // 0.
  const double now = up_B.dot(kinematics.ballTorque(wanted));
  double from = std::min(0.0, -spin_torque - now), to = std::max(0.0, spin_torque - now);
  for (int i = 0; i < kWheelCount; ++i) {
    if (std::abs(turn[i]) < 1e-6) continue;
    const double a = (low[i] - torque[i]) / turn[i], b = (high[i] - torque[i]) / turn[i];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  // Limits that exclude each other are met half way, and then by each wheel alone.
  const double shift = from <= to ? std::clamp(0.0, from, to) : 0.5 * (from + to);
  torque += shift * turn;
  return torque.cwiseMax(low).cwiseMin(high);
}

}  // namespace

void TractionBelief::describe(ConfigVisitor& v) {
  v.boolean(may("limited",
                "whether the wheels hold on to the ball by friction (robot.wheels.friction), which "
                "plan and command keep; or whatever they are asked for"),
            limited);
  v.number(may("command_share", "of what friction holds, what is commanded at most"), command_share,
           {0.1, 1});
  v.number(may("least_normal_N", "that a wheel is taken to bear, however little it is"),
           least_normal, {0, 1e4});
}

TractionLimit::TractionLimit(const RobotParameters& robot, const TractionBelief& belief)
    : belief_(belief),
      dynamics_(robot),
      model_(robot),
      kinematics_(robot),
      lever_(robot.wheels.friction * robot.wheels.radius),
      wheel_radius_(robot.wheels.radius),
      torque_limit_(robot.wheel_torque_limit),
      acts_(belief.limited && robot.wheels.friction < kUnlimited) {
  const double carried = robot.gravity * (robot.totalMass() - robot.ball.mass);
  normal_at_rest_ = carried / (3 * std::cos(robot.wheels.contact_zenith));
}

double TractionLimit::held(double normal) const noexcept {
  return lever_ * std::max(normal, belief_.least_normal);
}

WheelLoads TractionLimit::loads(const StateVector& x, const VelocityVector& push,
                                const JointVector& torque) const noexcept {
  const PositionVector q = x.head<kPositionDim>();
  VelocityVector dnu = dynamics_.acceleration(q, x.tail<kVelocityDim>(), torque, Vector3::Zero());
  Vector3 applied = Vector3::Zero();
  if (!push.isZero(0)) {
    dnu += dynamics_.massMatrix(q).ldlt().solve(push);
    applied.head<2>() = push.head<2>();
  }
  return model_.at(x, dnu, torque.head<kWheelCount>(), applied);
}

WheelFlags TractionLimit::overloaded(const StateVector& x, const VelocityVector& push,
                                     const JointVector& torque,
                                     const Vector3& grip) const noexcept {
  WheelFlags out{};
  if (!acts_) return out;
  const Vector3 normal = loads(x, push, torque).normal;
  for (int i = 0; i < kWheelCount; ++i) {
    out[static_cast<std::size_t>(i)] = normal[i] < kUnloadedShare * normal_at_rest_ ||
                                       std::abs(grip[i]) > kGripShare * held(normal[i]);
  }
  return out;
}

bool TractionLimit::cut(const StateVector& x, const VelocityVector& push, double spin_torque,
                        JointVector& torque) const noexcept {
  const double most = torque.head<kWheelCount>().cwiseAbs().maxCoeff();
  if (!acts_ || most < kIdleShare * lever_ * normal_at_rest_) return false;
  bool changed = false;
  const Matrix3 R_WB = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
  const Vector3 up_B = R_WB.transpose() * Vector3::UnitZ();
  // Twice: the normal forces follow from the torques.
  for (int pass = 0; pass < 2; ++pass) {
    const WheelLoads now = loads(x, push, torque);
    const Vector3 wanted = torque.head<kWheelCount>();
    // Part of the torque speeds up the wheel and reaches no contact.
    const Vector3 inner = wanted + wheel_radius_ * now.traction;
    const Vector3& N = now.normal;
    const Vector3 limit = belief_.command_share * Vector3(held(N[0]), held(N[1]), held(N[2]));
    const Vector3 drive = wanted.cwiseAbs().cwiseMax(torque_limit_);
    const Vector3 kept =
        redistributed(kinematics_, up_B, spin_torque, wanted, (inner - limit).cwiseMax(-drive),
                      (inner + limit).cwiseMin(drive));
    if (kept == wanted) break;
    torque.head<kWheelCount>() = kept;
    changed = true;
  }
  return changed;
}

}  // namespace ballbot
