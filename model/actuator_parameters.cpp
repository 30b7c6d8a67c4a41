#include "model/actuator_parameters.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"

namespace ballbot {

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

void ActuatorParameters::describe(ConfigVisitor& v) {
  const Range positive{kTiny, kInf}, not_negative{0, kInf};
  v.number(must("gear_ratio", "motor to joint"), gear_ratio, positive);
  v.number(must("motor_inertia_kgm2", "rotor inertia, motor side"), motor_inertia, positive);
  v.number(must("spring_stiffness_Nm_per_rad", "spring stiffness"), spring_stiffness, positive);
  v.number(must("spring_damping_Nms_per_rad", "spring damping"), spring_damping, not_negative);
  v.number(must("viscous_friction_Nms_per_rad", "viscous friction at the rotor, joint side"),
           viscous_friction, not_negative);
  v.number(must("coulomb_friction_Nm", "Coulomb friction"), coulomb_friction, not_negative);
  v.number(must("static_friction_Nm", "static friction"), static_friction, not_negative);
  v.number(must("stribeck_velocity_rad_per_s", "Stribeck velocity"), stribeck_velocity, positive);
  v.number(must("friction_smoothing_rad_per_s", "rate at which dry friction changes its sign"),
           friction_smoothing, positive);
  v.number(must("peak_torque_Nm", "motor torque at which it saturates, joint side"), peak_torque,
           positive);
  v.number(must("speed_limit_rad_per_s", "motor speed limit, joint side"), speed_limit, positive);
  v.number(must("current_loop_bandwidth_Hz", "bandwidth of the current loop"),
           current_loop_bandwidth, positive);
  v.number(must("torque_bandwidth_Hz", "wanted bandwidth of the torque loop, output blocked"),
           torque_bandwidth, positive);
  v.number(must("damping_ratio", "wanted damping of the torque loop, output blocked"),
           damping_ratio, positive);
  v.check([this](const ConfigReader& in) { requirePossible(in); });
}

void ActuatorParameters::requirePossible(const ConfigReader& in) const {
  if (static_friction < coulomb_friction) {
    throw InputError(fmt::format("{} is {}, must be at least coulomb_friction_Nm = {}",
                                 in.at("static_friction_Nm"), static_friction, coulomb_friction));
  }
  if (torqueGainP() < 0) {
    const double open_loop = std::sqrt(spring_stiffness / reflectedInertia()) / kTwoPi;
    throw InputError(fmt::format(
        "{} is {} Hz, below the {:.3g} Hz that spring and rotor have without feedback; a negative "
        "gain would be needed. Raise it, or lower spring_stiffness_Nm_per_rad",
        in.at("torque_bandwidth_Hz"), torque_bandwidth, open_loop));
  }
  if (torqueGainD() < 0) {
    const double least = viscous_friction / (2 * reflectedInertia() * kTwoPi * torque_bandwidth);
    throw InputError(fmt::format(
        "{} is {}, but viscous friction alone gives {:.3g} at {} Hz; a negative gain would be "
        "needed. Raise it, or lower viscous_friction_Nms_per_rad",
        in.at("damping_ratio"), damping_ratio, least, torque_bandwidth));
  }
}

ActuatorParameters ActuatorParameters::read(ConfigReader& in) {
  ActuatorParameters p;
  readDescribed(in, p);
  in.finish();
  return p;
}

}  // namespace ballbot
