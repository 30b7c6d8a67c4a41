#include "plant/plant_config.hpp"

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr int kMaxDelayTicks = 1000;

PlantFidelity readFidelity(ConfigReader in) {
  PlantFidelity f;
  f.multibody = in.choiceOr("multibody", f.multibody,
                            {{"full", MultibodyStructure::kFull},
                             {"reduced_wheels", MultibodyStructure::kReducedWheels}});
  f.actuators = in.choiceOr(
      "actuators", f.actuators,
      {{"ideal", ActuatorLevel::kIdeal}, {"series_elastic", ActuatorLevel::kSeriesElastic}});
  f.contact = in.choiceOr("contact", f.contact,
                          {{"rolling", ContactLevel::kRolling},
                           {"rolling_with_spin_friction", ContactLevel::kRollingWithSpinFriction},
                           {"compliant", ContactLevel::kCompliant}});
  if (f.contact == ContactLevel::kCompliant && f.multibody != MultibodyStructure::kFull) {
    throw InputError(
        fmt::format("{} is compliant, for which wheels must be bodies: set "
                    "fidelity.multibody to full",
                    in.at("contact")));
  }
  f.noisy_sensors = in.choiceOr("sensors", f.noisy_sensors, {{"perfect", false}, {"noisy", true}});
  f.encoder_quantisation = in.booleanOr("encoder_quantisation", f.encoder_quantisation);
  f.friction = in.booleanOr("friction", f.friction);
  f.saturation = in.booleanOr("saturation", f.saturation);
  f.speed_limit = in.booleanOr("speed_limit", f.speed_limit);
  f.transport_delay = in.booleanOr("transport_delay", f.transport_delay);
  in.finish();
  return f;
}

void readPlantSection(ConfigReader in, PlantConfig& c) {
  if (in.has("fidelity")) c.fidelity = readFidelity(in.child("fidelity"));
  if (in.has("spin_friction")) {
    ConfigReader spin = in.child("spin_friction");
    c.spin_friction.torque = spin.number("torque_Nm", {0, kInf});
    c.spin_friction.smoothing = spin.number("smoothing_rad_per_s", {1e-4, kInf});
    spin.finish();
  }
  if (in.has("compliant_contact")) {
    ConfigReader contact = in.child("compliant_contact");
    c.integration_tolerance = contact.numberOr("tolerance", c.integration_tolerance, {1e-12, 1e-2});
    c.floor = FloorContactParameters::read(contact);
  }
  if (in.has("wheel_loop_insertion")) {
    ConfigReader insertion = in.child("wheel_loop_insertion");
    c.wheel_loop.gain = insertion.numberOr("gain", c.wheel_loop.gain, {0, 1000});
    c.wheel_loop.delay_ticks =
        insertion.integerOr("delay_ticks", c.wheel_loop.delay_ticks, {0, kMaxDelayTicks});
    insertion.finish();
  }
  c.substep = in.durationOr("substep_us", c.substep, {1, 10'000});
  c.drive_period = in.durationOr("drive_period_us", c.drive_period, {1, 100'000});
  c.transport_delay_ticks =
      in.integerOr("transport_delay_ticks", c.transport_delay_ticks, {0, kMaxDelayTicks});
  c.leak_compensation = in.booleanOr("leak_compensation", c.leak_compensation);
  const auto offset = in.numbersOr<3>("base_com_offset_m", {0, 0, 0}, {-0.1, 0.1});
  c.robot.base.p_LLcm_L += Vector3(offset[0], offset[1], offset[2]);
  if (in.has("motion_capture")) {
    c.motion_capture = MotionCaptureParameters::read(in.child("motion_capture"));
  }
  c.faults = readFaults(in);
  for (const Fault& fault : c.faults) {
    if (fault.kind != Fault::Kind::kWheelSlip) continue;
    if (c.fidelity.multibody != MultibodyStructure::kFull) {
      throw InputError(
          fmt::format("{} hold a wheel_slip, for which wheels must be bodies: set "
                      "fidelity.multibody to full",
                      in.at("faults")));
    }
    if (c.fidelity.contact == ContactLevel::kCompliant) {
      throw InputError(
          fmt::format("{} hold a wheel_slip, which there is not with fidelity.contact: "
                      "compliant",
                      in.at("faults")));
    }
  }
  in.finish();
}

void readInitial(ConfigReader in, PlantConfig& c) {
  RobotPose& pose = c.initial.pose;
  pose.pitch = kRadPerDeg * in.numberOr("pitch_deg", 0, {-60, 60});
  pose.roll = kRadPerDeg * in.numberOr("roll_deg", 0, {-60, 60});
  pose.yaw = kRadPerDeg * in.numberOr("yaw_deg", 0, {-180, 180});
  c.initial.release = kSimStart + in.durationOr("release_s", SimDuration::zero(), {0, 100});
  if (in.has("arm_rad")) {
    const auto arm = in.numbers<kArmJointCount>("arm_rad");
    for (int j = 0; j < kArmJointCount; ++j) {
      const ArmLink& link = c.robot.arm[j];
      if (arm[j] < link.lower_limit || arm[j] > link.upper_limit) {
        throw InputError(fmt::format("{} puts '{}' at {} rad, must be between {} and {}",
                                     in.at("arm_rad"), link.name, arm[j], link.lower_limit,
                                     link.upper_limit));
      }
      pose.arm[j] = arm[j];
    }
  }
  in.finish();
}

void readEnvironment(ConfigReader in, PlantConfig& c) {
  c.pushes = readPushes(in, c.robot);
  c.surroundings = SurroundingsParameters::read(in);
  c.robot.payload_mass = in.numberOr("payload_kg", c.robot.payload_mass, {0, 100});
  in.finish();
}

}  // namespace

PlantConfig readPlantConfig(const ConfigNode& scenario) {
  ConfigReader in(scenario);
  PlantConfig c;
  c.seed = static_cast<std::uint64_t>(in.numberOr("seed", 1, {0, 9007199254740992.0}));
  ConfigReader robot = in.child("robot");
  c.robot = readRobot(robot);
  c.actuators = readActuators(robot);
  ConfigReader sensors = robot.child("sensors");
  c.sensors = SensorParameters::read(sensors);
  c.initial.pose.arm = c.robot.nominal_arm;
  if (in.has("plant")) readPlantSection(in.child("plant"), c);
  if (in.has("initial")) readInitial(in.child("initial"), c);
  if (in.has("environment")) readEnvironment(in.child("environment"), c);
  return c;
}

}  // namespace ballbot
