#include "hil/identify/configuration.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "model/actuator_response.hpp"

namespace ballbot {
namespace {

constexpr double kZeroShare = 0.4, kPoleOverZero = 2;
constexpr double kAgrees = 0.05, kSigmas = 2;

std::string line(const char* key, double value) { return fmt::format("{}: {:.5g}\n", key, value); }

std::string sigmaOf(const Identification& found, const char* key) {
  const Figure& f = found.figures.at(key);
  return fmt::format("  # {:.4g} +- {:.2g} {}\n", f.value, f.sigma, f.unit);
}

/// What of an actuator was identified, a line each, sigma behind it.
std::string identifiedLines(const Identification& found, const ActuatorParameters& p,
                            const std::string& indent) {
  std::string out;
  const auto add = [&](const char* key, double value, const char* figure) {
    std::string text = indent + line(key, value);
    text.pop_back();
    out += text + sigmaOf(found, figure);
  };
  if (found.has_current) {
    add("motor_inertia_kgm2", p.motor_inertia, "rotor_inertia_kgm2");
    add("spring_stiffness_Nm_per_rad", p.spring_stiffness, "stiffness_Nm_per_rad");
    add("spring_damping_Nms_per_rad", p.spring_damping, "spring_damping_Nms_per_rad");
    add("viscous_friction_Nms_per_rad", p.viscous_friction, "viscous_friction_Nms_per_rad");
    add("coulomb_friction_Nm", p.coulomb_friction, "coulomb_friction_Nm");
    out += indent + line("static_friction_Nm", p.static_friction);
  }
  add("torque_bandwidth_Hz", p.torque_bandwidth, "bandwidth_Hz");
  return out;
}

double figureOr(const Identification& found, const char* key, double otherwise) {
  const Figure& f = found.figures.at(key);
  return f.identified ? std::max(0.0, f.value) : otherwise;
}

}  // namespace

ActuatorParameters identifiedActuator(const Identification& found, const Configured& configured) {
  ActuatorParameters p = configured.actuator;
  const double above = p.static_friction - p.coulomb_friction;
  p.spring_stiffness = figureOr(found, "stiffness_Nm_per_rad", p.spring_stiffness);
  p.spring_damping = figureOr(found, "spring_damping_Nms_per_rad", p.spring_damping);
  p.motor_inertia =
      figureOr(found, "rotor_inertia_kgm2", p.reflectedInertia()) / (p.gear_ratio * p.gear_ratio);
  p.viscous_friction = figureOr(found, "viscous_friction_Nms_per_rad", p.viscous_friction);
  p.coulomb_friction = figureOr(found, "coulomb_friction_Nm", p.coulomb_friction);
  p.static_friction = p.coulomb_friction + above;
  p.torque_bandwidth =
      torqueBandwidthFor(p, configured.drive_period, found.figures.at("bandwidth_Hz").value);
  return p;
}

Verdict verdictOf(const Figure& f, const Configured& c) {
  Verdict v;
  const ActuatorParameters& a = c.actuator;
  const auto known = [&](double value) {
    v.has_configured = true;
    v.configured = value;
  };
  if (f.key == "stiffness_Nm_per_rad") known(a.spring_stiffness);
  if (f.key == "rotor_inertia_kgm2") known(a.reflectedInertia());
  if (f.key == "viscous_friction_Nms_per_rad") known(a.viscous_friction);
  if (f.key == "coulomb_friction_Nm") known(a.coulomb_friction);
  if (f.key == "spring_damping_Nms_per_rad") known(a.spring_damping);
  if (f.key == "load_friction" || f.key == "backlash_deg") known(0);
  if (f.key == "delay_ms") known(1e3 * c.torque_delay);
  if (f.key == "bandwidth_Hz") {
    known(TorqueResponse{2, kTwoPi * c.torque_frequency_Hz, c.torque_damping_ratio}.bandwidth_Hz());
  }
  if (!f.identified) {
    v.text = "not identified: " + f.why;
  } else if (v.has_configured) {
    const double tolerance = std::max(kSigmas * f.sigma, kAgrees * std::abs(v.configured));
    v.text = std::abs(f.value - v.configured) <= tolerance ? "agrees" : "differs";
  }
  return v;
}

std::string figureComments(const Identification& found, const std::string& drive) {
  std::string out = fmt::format("# {}, identified on the bench by `ballbot identify`.\n", drive);
  for (const Figure& f : found.figures.list) {
    if (f.identified) {
      out += fmt::format("#   {:<24} {:>9.4g} +- {:<8.2g} {}\n", f.name, f.value, f.sigma, f.unit);
    } else {
      out += fmt::format("#   {:<24} not identified: {}\n", f.name, f.why);
    }
  }
  return out;
}

std::string actuatorYaml(const Identification& found, const Configured& configured,
                         const std::string& drive) {
  const ActuatorParameters p = identifiedActuator(found, configured);
  return figureComments(found, drive) +
         "# The plant's actuators have neither load-dependent friction nor backlash.\n" +
         identifiedLines(found, p, "") + "# As configured before:\n" +
         line("gear_ratio", p.gear_ratio) +
         (found.has_current ? std::string()
                            : line("motor_inertia_kgm2", p.motor_inertia) +
                                  line("spring_stiffness_Nm_per_rad", p.spring_stiffness) +
                                  line("spring_damping_Nms_per_rad", p.spring_damping) +
                                  line("viscous_friction_Nms_per_rad", p.viscous_friction) +
                                  line("coulomb_friction_Nm", p.coulomb_friction) +
                                  line("static_friction_Nm", p.static_friction)) +
         line("stribeck_velocity_rad_per_s", p.stribeck_velocity) +
         line("friction_smoothing_rad_per_s", p.friction_smoothing) +
         line("peak_torque_Nm", p.peak_torque) + line("speed_limit_rad_per_s", p.speed_limit) +
         line("current_loop_bandwidth_Hz", p.current_loop_bandwidth) +
         line("damping_ratio", p.damping_ratio);
}

std::string scenarioYaml(const Identification& found, const Configured& configured,
                         const ScenarioNames& names) {
  const ActuatorParameters p = identifiedActuator(found, configured);
  std::string out = figureComments(found, names.drive);
  out +=
      "# torque_bandwidth_Hz is the setting with which the model's drive measures -3 dB there.\n";
  out += fmt::format("include: {}\nrobot:\n  actuators:\n", names.include);
  if (names.actuator_file.empty()) {
    out += fmt::format("    {}:\n{}", names.group, identifiedLines(found, p, "      "));
  } else {
    out += fmt::format("    {}: {{include: {}}}\n", names.group, names.actuator_file);
  }
  if (found.has_current) {
    const double ticks = 1e-3 * found.figures.at("delay_ms").value / configured.drive_period;
    out += fmt::format("plant:\n  transport_delay_ticks: {}{}", std::max(0L, std::lround(ticks)),
                       sigmaOf(found, "delay_ms"));
  }
  if (!names.shaping) return out;
  const double zero = kZeroShare * kTwoPi * p.torque_bandwidth;
  return out + fmt::format(
                   "controller:\n"
                   "  mpc:\n"
                   "    wheel_shaping: {{zero_rad_per_s: {:.4g}, pole_rad_per_s: {:.4g}}}\n",
                   zero, kPoleOverZero * zero);
}

}  // namespace ballbot
