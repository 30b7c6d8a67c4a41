#include "plant/torque_drive.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "model/pd_law.hpp"

namespace ballbot {
namespace {

// The compensation is positive feedback of the motor's acceleration, so it must stay slower than
// the torque loop that surrounds it.
constexpr double kCompensationBandwidthShare = 0.5;

}  // namespace

TorqueDrive::TorqueDrive(const ActuatorParameters& p, const DriveOptions& options)
    : p_(p),
      options_(options),
      gain_p_(p.torqueGainP()),
      gain_d_(p.torqueGainD()),
      filter_rate_(kTwoPi * kCompensationBandwidthShare * p.torque_bandwidth),
      filter_share_(1 - std::exp(-filter_rate_ * toSeconds(options.period))) {}

double TorqueDrive::wantedTorque(const DriveCommand& c, const DriveReading& r) {
  return pdTorque<double>(c.torque, c.stiffness, c.position, c.damping, c.velocity, r.joint_angle,
                          r.joint_velocity);
}

double TorqueDrive::tick(double wanted, const DriveReading& r) {
  double motor = wanted;
  if (options_.torque_loop) {
    const double spring = p_.spring_stiffness * (r.motor_angle - r.joint_angle);
    const double spring_rate = p_.spring_stiffness * (r.motor_velocity - r.joint_velocity);
    motor += gain_p_ * (wanted - spring) - gain_d_ * spring_rate;
    if (options_.leak_compensation) {
      const double acceleration = filter_rate_ * (r.motor_velocity - slow_velocity_);
      slow_velocity_ += filter_share_ * (r.motor_velocity - slow_velocity_);
      motor += p_.reflectedInertia() * acceleration + p_.viscous_friction * slow_velocity_;
    }
  }
  return options_.saturation ? std::clamp(motor, -p_.peak_torque, p_.peak_torque) : motor;
}

}  // namespace ballbot
