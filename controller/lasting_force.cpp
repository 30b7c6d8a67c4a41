#include "controller/lasting_force.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

constexpr double kSmoothing_s = 0.1;  // of what is looked at for changes: friction makes noise
constexpr double kHandChange_N = 4;
/// Felt in the hand beside what is counted on: nothing to speak of, 0.1 kg [N].
constexpr double kHandKnown_N = 1;
/// Of a weight in the hand, what a robot that moves takes for a force sideways.
constexpr double kSidewaysShare = 0.15;

VelocityVector byRow(double force, double moment, double arm) {
  VelocityVector out;
  out << force, force, moment, moment, moment, ArmVector::Constant(arm);
  return out;
}

}  // namespace

LastingForce::LastingForce(const RobotParameters& robot, const OffsetFree& settings)
    : settings_(settings),
      known_payload_(robot.payload_mass),
      gravity_(robot.gravity),
      change_(byRow(settings.force_change_N, settings.moment_change_Nm, settings.arm_change_Nm)),
      limit_(byRow(settings.force_limit_N, settings.moment_limit_Nm, settings.arm_limit_Nm)) {}

void LastingForce::reset() noexcept {
  started_ = learning_ = false;
  hand_known_ = true;
  hand_force_.setZero();
  hand_weight_ = hand_reference_ = 0;
  forces_ = {};
}

void LastingForce::update(SimTime now, const Unexplained& felt) noexcept {
  learning_ = false;
  if (!settings_.enabled || !felt.residual.allFinite() || !felt.hand_force_W.allFinite()) return;
  const double dt = started_ ? toSeconds(now - last_) : 0;
  last_ = now;
  const bool first = !started_;
  started_ = true;
  if (first) {
    hand_settled_since_ = settled_since_ = now;
    smooth_ = reference_ = felt.residual;
  }
  const double share = std::min(1.0, dt / kSmoothing_s);
  hand_force_ += share * (felt.hand_force_W - hand_force_);
  smooth_ += share * (felt.residual - smooth_);
  const double weight = gravity_ * std::abs(forces_.hand_mass) + std::abs(hand_force_.z());
  const bool touches = hand_force_.head<2>().norm() > settings_.touch_N + kSidewaysShare * weight;
  const bool otherwise = felt.otherwise || touches;
  learnHand(now, dt, felt.hand_force_W, otherwise);
  learnRest(now, dt, otherwise);
}

void LastingForce::learnRest(SimTime now, double dt, bool otherwise) noexcept {
  const bool changed = ((smooth_ - reference_).cwiseAbs().array() > change_.array()).any();
  if (changed) reference_ = smooth_;
  // The hand first: until its weight is known, its moment would be learned as another.
  if (changed || otherwise || !hand_known_) settled_since_ = now;
  if (toSeconds(now - settled_since_) < settings_.settled_after) return;
  learning_ = true;
  VelocityVector& rest = forces_.rest;
  rest += std::min(1.0, dt / settings_.time_constant) * (smooth_ - rest);
  rest = rest.cwiseMax(-limit_).cwiseMin(limit_);
}

void LastingForce::learnHand(SimTime now, double dt, const Vector3& force_W,
                             bool otherwise) noexcept {
  const double felt = gravity_ * forces_.hand_mass - force_W.z();
  hand_weight_ += std::min(1.0, dt / kSmoothing_s) * (felt - hand_weight_);
  const bool changed = std::abs(hand_weight_ - hand_reference_) > kHandChange_N;
  if (changed) hand_reference_ = hand_weight_;
  if (changed || otherwise) hand_settled_since_ = now;
  hand_known_ = std::abs(hand_force_.z()) < kHandKnown_N;
  if (toSeconds(now - hand_settled_since_) < settings_.settled_after) return;
  const double share = std::min(1.0, dt / settings_.hand_time_constant);
  forces_.hand_mass = std::clamp(forces_.hand_mass - share * force_W.z() / gravity_,
                                 std::max(-known_payload_, -settings_.hand_mass_limit_kg),
                                 settings_.hand_mass_limit_kg);
}

}  // namespace ballbot
