#include "model/actuator_parameters.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {}  // namespace

// Output blocked: tau_s/tau_d = k (1 + Kp) / (J s^2 + (B + k Kd) s + k (1 + Kp)). Both gains follow
// from its natural frequency and damping.
double ActuatorParameters::torqueGainP() const {
  const double w = kTwoPi * torque_bandwidth;
  return reflectedInertia() * w * w / spring_stiffness - 1;
}

double ActuatorParameters::torqueGainD() const {
  const double w = kTwoPi * torque_bandwidth;
  return (2 * damping_ratio * reflectedInertia() * w - viscous_friction) / spring_stiffness;
}

ActuatorParameters ActuatorParameters::read(ConfigReader& in) {
  ActuatorParameters p;
  const Range positive{kTiny, kInf}, not_negative{0, kInf};
  p.gear_ratio = in.number("gear_ratio", positive);
  p.motor_inertia = in.number("motor_inertia_kgm2", positive);
  p.spring_stiffness = in.number("spring_stiffness_Nm_per_rad", positive);
  p.spring_damping = in.number("spring_damping_Nms_per_rad", not_negative);
  p.viscous_friction = in.number("viscous_friction_Nms_per_rad", not_negative);
  p.coulomb_friction = in.number("coulomb_friction_Nm", not_negative);
  p.static_friction = in.number("static_friction_Nm", not_negative);
  p.stribeck_velocity = in.number("stribeck_velocity_rad_per_s", positive);
  p.friction_smoothing = in.number("friction_smoothing_rad_per_s", positive);
  p.peak_torque = in.number("peak_torque_Nm", positive);
  p.speed_limit = in.number("speed_limit_rad_per_s", positive);
  p.current_loop_bandwidth = in.number("current_loop_bandwidth_Hz", positive);
  p.torque_bandwidth = in.number("torque_bandwidth_Hz", positive);
  p.damping_ratio = in.number("damping_ratio", positive);
  in.finish();

  if (p.static_friction < p.coulomb_friction) {
    throw InputError(fmt::format("{} is {}, must be at least coulomb_friction_Nm = {}",
                                 in.at("static_friction_Nm"), p.static_friction,
                                 p.coulomb_friction));
  }
  if (p.torqueGainP() < 0) {
    const double open_loop = std::sqrt(p.spring_stiffness / p.reflectedInertia()) / kTwoPi;
    throw InputError(fmt::format(
        "{} is {} Hz, below the {:.3g} Hz that spring and rotor have without feedback; a negative "
        "gain would be needed. Raise it, or lower spring_stiffness_Nm_per_rad",
        in.at("torque_bandwidth_Hz"), p.torque_bandwidth, open_loop));
  }
  if (p.torqueGainD() < 0) {
    const double least =
        p.viscous_friction / (2 * p.reflectedInertia() * kTwoPi * p.torque_bandwidth);
    throw InputError(fmt::format(
        "{} is {}, but viscous friction alone gives {:.3g} at {} Hz; a negative gain would be "
        "needed. Raise it, or lower viscous_friction_Nms_per_rad",
        in.at("damping_ratio"), p.damping_ratio, least, p.torque_bandwidth));
  }
  return p;
}

}  // namespace ballbot
