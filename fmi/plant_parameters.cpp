#include "fmi/plant_parameters.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {
namespace {

PlantParameter real(std::string path, const char* unit, const char* description, double fallback) {
  return {std::move(path), VariableType::kReal, unit, description, fallback, {}, {}};
}
PlantParameter flag(std::string path, const char* description, bool fallback) {
  return {std::move(path), VariableType::kBoolean, "", description, fallback ? 1.0 : 0.0, {}, {}};
}
PlantParameter whole(std::string path, const char* description, double fallback) {
  return {std::move(path), VariableType::kInteger, "", description, fallback, {}, {}};
}
PlantParameter choice(std::string path, const char* description, double fallback,
                      std::vector<std::string> choices) {
  return {std::move(path), VariableType::kEnumeration, "", description,
          fallback,        std::move(choices),         {}};
}

void addActuator(std::vector<PlantParameter>& out, const std::string& group,
                 const std::string& who) {
  const ActuatorParameters a;
  const auto add = [&](const char* key, const char* unit, const std::string& text,
                       double fallback) {
    out.push_back(real("robot.actuators." + group + "." + key, unit, "", fallback));
    out.back().description = who + ": " + text;
  };
  add("gear_ratio", "", "motor to joint", a.gear_ratio);
  add("motor_inertia_kgm2", "kg m^2", "rotor inertia, motor side", a.motor_inertia);
  add("spring_stiffness_Nm_per_rad", "N m/rad", "spring stiffness", a.spring_stiffness);
  add("spring_damping_Nms_per_rad", "N m s/rad", "spring damping", a.spring_damping);
  add("viscous_friction_Nms_per_rad", "N m s/rad", "viscous friction at the rotor, joint side",
      a.viscous_friction);
  add("coulomb_friction_Nm", "N m", "Coulomb friction", a.coulomb_friction);
  add("static_friction_Nm", "N m", "static friction", a.static_friction);
  add("stribeck_velocity_rad_per_s", "rad/s", "Stribeck velocity", a.stribeck_velocity);
  add("peak_torque_Nm", "N m", "motor torque at which it saturates, joint side", a.peak_torque);
  add("speed_limit_rad_per_s", "rad/s", "motor speed limit, joint side", a.speed_limit);
  add("current_loop_bandwidth_Hz", "Hz", "bandwidth of the current loop", a.current_loop_bandwidth);
  add("torque_bandwidth_Hz", "Hz", "wanted bandwidth of the torque loop, output blocked",
      a.torque_bandwidth);
  add("damping_ratio", "", "wanted damping of the torque loop, output blocked", a.damping_ratio);
}

void addSensors(std::vector<PlantParameter>& out) {
  const ImuParameters i;
  const EncoderParameters e;
  const std::string imu = "robot.sensors.imu.", encoders = "robot.sensors.encoders.";
  out.push_back(real(imu + "gyro_noise_rad_per_s_per_sqrtHz", "rad/s/sqrt(Hz)",
                     "density of the gyroscope's white noise", i.gyro_noise));
  out.push_back(real(imu + "accel_noise_m_per_s2_per_sqrtHz", "m/s^2/sqrt(Hz)",
                     "density of the accelerometer's white noise", i.accel_noise));
  out.push_back(real(imu + "gyro_bias_walk_rad_per_s_per_sqrts", "rad/s/sqrt(s)",
                     "random walk of the gyroscope's bias", i.gyro_bias_walk));
  out.push_back(real(imu + "accel_bias_walk_m_per_s2_per_sqrts", "m/s^2/sqrt(s)",
                     "random walk of the accelerometer's bias", i.accel_bias_walk));
  out.push_back(real(imu + "gyro_turn_on_bias_rad_per_s", "rad/s",
                     "standard deviation of the gyroscope's bias after switching on",
                     i.gyro_turn_on_bias));
  out.push_back(real(imu + "accel_turn_on_bias_m_per_s2", "m/s^2",
                     "standard deviation of the accelerometer's bias after switching on",
                     i.accel_turn_on_bias));
  out.push_back(real(imu + "gyro_resolution_rad_per_s", "rad/s",
                     "quantum of the gyroscope's output, 0 for none", i.gyro_resolution));
  out.push_back(real(imu + "accel_resolution_m_per_s2", "m/s^2",
                     "quantum of the accelerometer's output, 0 for none", i.accel_resolution));
  out.push_back(real(encoders + "motor_resolution_deg", "deg",
                     "quantum of the encoder behind the gear, joint side",
                     e.motor_resolution / kRadPerDeg));
  out.push_back(real(encoders + "joint_resolution_deg", "deg",
                     "quantum of the encoder behind the spring", e.joint_resolution / kRadPerDeg));
  out.push_back(real(encoders + "velocity_filter_Hz", "Hz",
                     "low-pass on the differenced joint angle", e.joint_velocity_filter));
}

std::vector<PlantParameter> makeParameters() {
  const PlantFidelity f;
  const PlantConfig c;
  const std::string fidelity = "plant.fidelity.";
  std::vector<PlantParameter> out = {
      whole("seed", "of every noise source", static_cast<double>(c.seed)),
      choice(fidelity + "multibody", "how the robot is cut into bodies; same motion",
             f.multibody == MultibodyStructure::kFull ? 1 : 2, {"full", "reduced_wheels"}),
      choice(fidelity + "actuators", "torque at once, or through motor, gear and spring",
             f.actuators == ActuatorLevel::kIdeal ? 1 : 2, {"ideal", "series_elastic"}),
      choice(fidelity + "contact",
             "whether the ball may spin about the vertical, and the floor give way",
             1 + static_cast<int>(f.contact),
             {"rolling", "rolling_with_spin_friction", "compliant"}),
      choice(fidelity + "sensors", "exact values, or noise, bias and quantisation",
             f.noisy_sensors ? 2 : 1, {"perfect", "noisy"}),
      flag(fidelity + "encoder_quantisation", "whole encoder counts; with noisy sensors",
           f.encoder_quantisation),
      flag(fidelity + "friction", "viscous, Coulomb and Stribeck friction at the rotors",
           f.friction),
      flag(fidelity + "saturation", "motor torque ends at its peak", f.saturation),
      flag(fidelity + "speed_limit", "no torque left beyond the motor's speed limit",
           f.speed_limit),
      flag(fidelity + "transport_delay", "commands are on their way for some drive ticks",
           f.transport_delay),
      whole("plant.transport_delay_ticks", "drive ticks from command to drive",
            c.transport_delay_ticks),
      flag("plant.leak_compensation", "drives feed their rotor's inertia and drag forward",
           c.leak_compensation),
      real("initial.pitch_deg", "deg", "pitch at the start", 0),
      real("initial.roll_deg", "deg", "roll at the start", 0),
      real("initial.yaw_deg", "deg", "yaw at the start", 0),
      real("initial.release_s", "s", "until then a stand holds the robot still", 0),
      real("environment.payload_kg", "kg", "point mass at the end-effector", 0),
  };
  out.back().otherwise = "robot.payload_mass_kg";
  addActuator(out, "wheel", "wheels");
  addActuator(out, "arm", "arm joints");
  addSensors(out);
  return out;
}

/// The mapping that should hold the last part of a dotted path.
struct Place {
  const ConfigNode* parent = nullptr;
  std::string path, key;
  bool found() const { return parent && parent->find(key); }
};

Place find(const ConfigNode& root, const std::string& dotted) {
  Place place{&root, "", dotted};
  const std::size_t last = dotted.rfind('.');
  if (last == std::string::npos) return place;
  place.path = dotted.substr(0, last);
  place.key = dotted.substr(last + 1);
  for (std::size_t begin = 0; place.parent && begin <= last;) {
    const std::size_t dot = std::min(dotted.find('.', begin), last);
    place.parent = place.parent->find(dotted.substr(begin, dot - begin));
    begin = dot + 1;
  }
  return place;
}

}  // namespace

const std::vector<PlantParameter>& plantParameters() {
  static const std::vector<PlantParameter> parameters = makeParameters();
  return parameters;
}

double parameterValue(const PlantParameter& p, const ConfigNode& scenario) {
  Place place = find(scenario, p.path);
  if (!place.found() && !p.otherwise.empty()) place = find(scenario, p.otherwise);
  if (!place.found()) return p.fallback;
  const std::string& key = place.key;
  ConfigReader in(*place.parent, place.path);
  switch (p.type) {
    case VariableType::kBoolean:
      return in.boolean(key) ? 1 : 0;
    case VariableType::kEnumeration: {
      const std::string text = in.text(key);
      const auto it = std::find(p.choices.begin(), p.choices.end(), text);
      if (it == p.choices.end()) {
        throw InputError(fmt::format("{} is '{}', must be one of: {}", in.at(key), text,
                                     fmt::join(p.choices, ", ")));
      }
      return static_cast<double>(it - p.choices.begin()) + 1;
    }
    default:
      return in.number(key);
  }
}

void setParameter(const PlantParameter& p, double value, ConfigNode& scenario) {
  std::string text;
  switch (p.type) {
    case VariableType::kReal:
      text = fmt::format("{}", value);
      break;
    case VariableType::kBoolean:
      text = value != 0 ? "true" : "false";
      break;
    case VariableType::kInteger:
      text = fmt::format("{}", static_cast<std::int64_t>(value));
      break;
    case VariableType::kEnumeration:
      if (!(value >= 1 && value <= static_cast<double>(p.choices.size()))) {
        throw InputError(fmt::format("{} is {}, must be 1 to {}: {}", p.path, value,
                                     p.choices.size(), fmt::join(p.choices, ", ")));
      }
      text = p.choices[static_cast<std::size_t>(value) - 1];
      break;
  }
  setPath(scenario, p.path, ConfigNode::scalar(text, false, {"parameter " + p.path, 0, 0}));
}

}  // namespace ballbot
