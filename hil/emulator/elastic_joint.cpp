#include "hil/emulator/elastic_joint.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "plant/series_elastic_actuator.hpp"

namespace ballbot {
namespace {

// The hand: two slow swings, always on one side of where it began, so that no stop is near.
constexpr double kSwing[2] = {0.30, 0.17}, kSwingRate[2] = {kTwoPi * 0.45, kTwoPi * 1.03};
constexpr double kHandRamp = 0.3;           // to its full speed and back to rest [s]
constexpr std::int64_t kQuietTicks = 1000;  // without torque, after which it stops
constexpr double kAlmostNoTorque = 1e-3;    // [N m]

DriveOptions optionsOf() {
  DriveOptions o;
  o.period = SimDuration{100'000};
  return o;
}

}  // namespace

void ElasticJointParameters::describe(ConfigVisitor& v) {
  const Range not_negative{0, kInf};
  v.section(may("actuator", "motor, gear, spring and torque loop, as in a robot's file"),
            [this](ConfigVisitor& in) { actuator.describe(in); });
  v.number(may("load_friction", "of the gear, share of the torque that goes through it"),
           load_friction, {0, 0.9});
  v.number(may("backlash_deg", "between gear and spring, from flank to flank"), backlash, {0, 10},
           kRadPerDeg);
  v.number(may("delay_ms", "of torque commands, rounded up to the drive's tick"), command_delay,
           {0, 50}, 1e-3);
  v.number(may("load_inertia_kgm2", "on a free output"), load_inertia, {1e-4, 1e3});
  v.number(may("load_damping_Nms_per_rad", "likewise"), load_damping, not_negative);
  v.number(may("motor_angle_noise_deg", "of a sample, rms"), motor_angle_noise, not_negative,
           kRadPerDeg);
  v.number(may("joint_angle_noise_deg", "of a sample, rms"), joint_angle_noise, not_negative,
           kRadPerDeg);
  v.number(may("motor_torque_noise_Nm", "of the mean over a cycle, rms"), motor_torque_noise,
           not_negative);
}

ElasticJoint::ElasticJoint(const ElasticJointParameters& p)
    : p_(p), drive_(p.actuator, optionsOf()) {}

void ElasticJoint::setOutput(StandOutput output) {
  if (output == output_) return;
  output_ = output;
  x_.joint_velocity = x_.motor_velocity = 0;
  hand_ = hand_time_ = 0;
}

double ElasticJoint::springTorque(const State& x) const {
  const double deflection = x.motor_angle - x.joint_angle, half = 0.5 * p_.backlash;
  if (std::abs(deflection) < half) return 0;
  return p_.actuator.spring_stiffness * (deflection - std::clamp(deflection, -half, half)) +
         p_.actuator.spring_damping * (x.motor_velocity - x.joint_velocity);
}

ElasticJoint::State ElasticJoint::slope(const State& x, double motor_torque) const {
  const ActuatorParameters& a = p_.actuator;
  const double spring = springTorque(x);
  const double gear =
      p_.load_friction * std::abs(spring) * std::tanh(x.motor_velocity / a.friction_smoothing);
  const double friction = actuatorFriction(a, x.motor_velocity) + gear;
  State d;
  d.motor_angle = x.motor_velocity;
  d.motor_velocity = (motor_torque - spring - friction) / a.reflectedInertia();
  d.joint_angle = x.joint_velocity;
  if (output_ == StandOutput::kFree) {
    d.joint_velocity = (spring - p_.load_damping * x.joint_velocity) / p_.load_inertia;
  }
  return d;
}

// Fourth order with the motor torque of begin, middle and end of the tick: the current loop's lag
// in closed form.
void ElasticJoint::tick(const DriveCommand& command) {
  const DriveReading r{x_.motor_angle, x_.motor_velocity, x_.joint_angle, x_.joint_velocity};
  const double demand = drive_.tick(TorqueDrive::wantedTorque(command, r), r);
  const double rate = kTwoPi * p_.actuator.current_loop_bandwidth, start = motor_torque_;
  const auto torqueAt = [&](double t) { return demand + (start - demand) * std::exp(-rate * t); };
  const double middle = torqueAt(0.5 * kTick), end = torqueAt(kTick);
  const auto moved = [](const State& x, double h, const State& d) {
    return State{x.motor_angle + h * d.motor_angle, x.motor_velocity + h * d.motor_velocity,
                 x.joint_angle + h * d.joint_angle, x.joint_velocity + h * d.joint_velocity};
  };
  const State k1 = slope(x_, start), k2 = slope(moved(x_, 0.5 * kTick, k1), middle);
  const State k3 = slope(moved(x_, 0.5 * kTick, k2), middle), k4 = slope(moved(x_, kTick, k3), end);
  x_ = moved(moved(moved(moved(x_, kTick / 6, k1), kTick / 3, k2), kTick / 3, k3), kTick / 6, k4);
  motor_torque_ = end;
  mean_motor_torque_ += demand + (start - demand) * (1 - std::exp(-rate * kTick)) / (rate * kTick);
}

void ElasticJoint::turnByHand() {
  const bool wanted = quiet_ticks_ < kQuietTicks && ticks_ > 0;
  hand_ = std::clamp(hand_ + (wanted ? kTick : -kTick) / kHandRamp, 0.0, 1.0);
  hand_time_ += hand_ * kTick;
  x_.joint_velocity = 0;
  for (int i = 0; i < 2; ++i) {
    x_.joint_velocity += hand_ * kSwing[i] * kSwingRate[i] * std::sin(kSwingRate[i] * hand_time_);
  }
}

bool ElasticJoint::atRest(const DriveCommand& c) const {
  const bool asked = c.torque != 0 || c.stiffness != 0 || c.damping != 0;
  return !asked && on_the_way_.empty() && motor_torque_ == 0 && x_.motor_velocity == 0 &&
         x_.joint_velocity == 0 && x_.motor_angle == x_.joint_angle && hand_ == 0;
}

void ElasticJoint::advance(double dt, const DriveCommand& command) {
  mean_motor_torque_ = 0;
  const auto count = static_cast<std::int64_t>(std::llround(dt / kTick));
  const auto delay = static_cast<std::int64_t>(std::ceil(p_.command_delay / kTick - 1e-9));
  if (atRest(command)) {  // exactly: nothing would move
    ticks_ += count;
    return;
  }
  on_the_way_.emplace_back(ticks_ + delay, command);
  for (std::int64_t i = 0; i < count; ++i) {
    while (!on_the_way_.empty() && on_the_way_.front().first <= ticks_) {
      acting_ = on_the_way_.front().second;
      on_the_way_.pop_front();
    }
    quiet_ticks_ = std::abs(acting_.torque) > kAlmostNoTorque ? 0 : quiet_ticks_ + 1;
    if (output_ == StandOutput::kTurned) turnByHand();
    tick(acting_);
    ++ticks_;
  }
  mean_motor_torque_ /= static_cast<double>(std::max<std::int64_t>(count, 1));
}

}  // namespace ballbot
