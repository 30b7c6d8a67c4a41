#include "plant/plant_config.hpp"

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_values.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr int kMaxDelayTicks = 1000;

void describePlantSection(ConfigVisitor& v, PlantConfig& c, FaultKeys fault_keys) {
  v.section(may("fidelity", "how true to the robot the plant is; each switch can be changed alone"),
            [&](ConfigVisitor& in) { c.fidelity.describe(in); });
  v.section(may("spin_friction",
                "of the floor on the ball's spin about the vertical; without effect where "
                "fidelity.contact is "
                "rolling"),
            [&](ConfigVisitor& in) { c.spin_friction.describe(in); });
  v.section(may("compliant_contact", "floor and integration of a contact that is compliant"),
            [&](ConfigVisitor& in) {
              in.number(may("tolerance", "error per integration step, relative to 1 + the size"),
                        c.integration_tolerance, {1e-12, 1e-2});
              c.floor.describe(in);
            });
  v.section(
      may("wheel_contact", "friction of the wheels on the ball, where fidelity.wheels is slipping"),
      [&](ConfigVisitor& in) { c.wheel_contact.describe(in); });
  v.section(may("wheel_loop_insertion",
                "gain and delay put into the loop at the wheel torques, to find out what it takes"),
            [&](ConfigVisitor& in) { c.wheel_loop.describe(in); });
  v.duration(may("substep_us", "longest integration step"), c.substep, {1, 10'000});
  v.duration(may("drive_period_us", "tick of the drives' torque loops and joint PD"),
             c.drive_period, {1, 100'000});
  v.integer(may("transport_delay_ticks", "drive ticks from command to drive"),
            c.transport_delay_ticks, {0, kMaxDelayTicks});
  v.boolean(may("leak_compensation", "drives feed their rotor's inertia and drag forward"),
            c.leak_compensation);
  v.vector(may("base_com_offset_m",
               "how far off the base's centre of mass is from what the controller's model says"),
           c.base_com_offset, {-0.1, 0.1});
  c.added_sensors.describe(v);
  v.section(may("motion_capture", "cameras that report the ball's place and the base's yaw"),
            [&](ConfigVisitor& in) { c.motion_capture.emplace().describe(in); });
  describeFaults(v, c.faults, fault_keys);
}

void describeEnvironmentSection(ConfigVisitor& v, PlantConfig& c) {
  describePushes(v, c.pushes, c.robot);
  c.surroundings.describe(v);
  c.slope.describe(v);
  v.number(may("payload_kg", "point mass at the end-effector; instead of robot.payload_mass_kg"),
           c.robot.payload_mass, {0, 100});
}

/// Of what needs contacts of wheels on the ball that can be told apart.
void requireWheelContacts(const PlantConfig& c, const std::string& at, const char* what) {
  if (c.fidelity.multibody != MultibodyStructure::kFull) {
    throw InputError(fmt::format(
        "{} {}, for which wheels must be bodies: set fidelity.multibody to full", at, what));
  }
  if (c.fidelity.contact == ContactLevel::kCompliant) {
    throw InputError(
        fmt::format("{} {}, which there is not with fidelity.contact: compliant; set that to "
                    "rolling_with_spin_friction",
                    at, what));
  }
}

void readPlantSection(ConfigReader in, PlantConfig& c) {
  if (c.robot.wheels.friction < kUnlimited) c.wheel_contact.friction = c.robot.wheels.friction;
  ConfigReading reading(in);
  describePlantSection(reading, c, FaultKeys::kOfItsKind);
  c.robot.base.p_LLcm_L += c.base_com_offset;
  if (c.fidelity.contact == ContactLevel::kCompliant &&
      c.fidelity.multibody != MultibodyStructure::kFull) {
    throw InputError(
        fmt::format("{} is compliant, for which wheels must be bodies: set "
                    "fidelity.multibody to full",
                    in.child("fidelity").at("contact")));
  }
  if (c.fidelity.wheels_slip)
    requireWheelContacts(c, in.child("fidelity").at("wheels"), "is slipping");
  if (c.wheel_contact.recorded) {
    requireWheelContacts(c, in.child("wheel_contact").at("recorded"), "is true");
  }
  for (const Fault& fault : c.faults) {
    if (fault.kind == Fault::Kind::kWheelSlip) {
      requireWheelContacts(c, in.at("faults"), "hold a wheel_slip");
    }
  }
  in.finish();
}

void readInitial(ConfigReader in, PlantConfig& c) {
  ConfigReading reading(in);
  c.initial.describe(reading, c.robot);
  in.finish();
}

void readEnvironment(ConfigReader in, PlantConfig& c) {
  ConfigReading reading(in);
  describeEnvironmentSection(reading, c);
  in.finish();
}

}  // namespace

void PlantFidelity::describe(ConfigVisitor& v) {
  v.choice(may("multibody", "how the robot is cut into bodies; same motion"), multibody,
           {{"full", MultibodyStructure::kFull},
            {"reduced_wheels", MultibodyStructure::kReducedWheels}});
  v.choice(may("actuators", "torque at once, or through motor, gear and spring"), actuators,
           {{"ideal", ActuatorLevel::kIdeal}, {"series_elastic", ActuatorLevel::kSeriesElastic}});
  v.choice(may("contact", "whether the ball may spin about the vertical, and the floor give way"),
           contact,
           {{"rolling", ContactLevel::kRolling},
            {"rolling_with_spin_friction", ContactLevel::kRollingWithSpinFriction},
            {"compliant", ContactLevel::kCompliant}});
  v.choice(may("wheels", "whether the wheels can slip on the ball for want of normal force"),
           wheels_slip, {{"rolling", false}, {"slipping", true}});
  v.choice(may("sensors", "exact values, or noise, bias and quantisation"), noisy_sensors,
           {{"perfect", false}, {"noisy", true}});
  v.boolean(may("encoder_quantisation", "whole encoder counts; with noisy sensors"),
            encoder_quantisation);
  v.boolean(may("friction", "viscous, Coulomb and Stribeck friction at the rotors"), friction);
  v.boolean(may("saturation", "motor torque ends at its peak"), saturation);
  v.boolean(may("speed_limit", "no torque left beyond the motor's speed limit"), speed_limit);
  v.boolean(may("transport_delay", "commands are on their way for some drive ticks"),
            transport_delay);
}

void LoopInsertion::describe(ConfigVisitor& v) {
  v.number(may("gain", "factor on the torque that the wheels' joint loops want"), gain, {0, 1000});
  v.integer(may("delay_ticks", "drive ticks by which that torque comes later"), delay_ticks,
            {0, kMaxDelayTicks});
}

void InitialCondition::describe(ConfigVisitor& v, const RobotParameters& robot) {
  v.number(may("pitch_deg", "pitch at the start"), pose.pitch, {-60, 60}, kRadPerDeg);
  v.number(may("roll_deg", "roll at the start"), pose.roll, {-60, 60}, kRadPerDeg);
  v.number(may("yaw_deg", "yaw at the start"), pose.yaw, {-180, 180}, kRadPerDeg);
  SimDuration held = release - kSimStart;
  v.duration(may("release_s", "until then a stand holds the robot still"), held, {0, 100});
  release = kSimStart + held;
  // No plain list: what stands in its place are the robot's own angles, and so are the limits.
  v.other(may("arm_rad", "angles of the arm at the start; without it robot.nominal_arm_rad"),
          "list of 3 numbers, within the limits of their joints", [&](ConfigReader& in) {
            const auto arm = in.numbers<kArmJointCount>("arm_rad");
            for (int j = 0; j < kArmJointCount; ++j) {
              const ArmLink& link = robot.arm[j];
              if (arm[j] < link.lower_limit || arm[j] > link.upper_limit) {
                throw InputError(fmt::format("{} puts '{}' at {} rad, must be between {} and {}",
                                             in.at("arm_rad"), link.name, arm[j], link.lower_limit,
                                             link.upper_limit));
              }
              pose.arm[j] = arm[j];
            }
          });
}

PlantConfig readPlantConfig(const ConfigNode& scenario) {
  ConfigReader in(scenario);
  ConfigReader robot = in.child("robot");
  return readPlantConfig(scenario, readRobot(robot));
}

PlantConfig readPlantConfig(const ConfigNode& scenario, const RobotParameters& nominal) {
  ConfigReader in(scenario);
  PlantConfig c;
  ConfigReading reading(in);
  describeSeed(reading, c.seed);
  ConfigReader robot = in.child("robot");
  c.robot = nominal;
  c.actuators = readActuators(robot);
  ConfigReader sensors = robot.child("sensors");
  readDescribed(sensors, c.sensors);
  sensors.finish();
  c.initial.pose.arm = c.robot.nominal_arm;
  if (in.has("plant")) readPlantSection(in.child("plant"), c);
  if (in.has("initial")) readInitial(in.child("initial"), c);
  if (in.has("environment")) readEnvironment(in.child("environment"), c);
  return c;
}

void describePlant(ConfigVisitor& v) {
  PlantConfig c;
  describePlantSection(v, c, FaultKeys::kOfEveryKind);
}

void describeInitial(ConfigVisitor& v) {
  PlantConfig c;
  c.initial.describe(v, c.robot);
}

void describeEnvironment(ConfigVisitor& v) {
  PlantConfig c;
  describeEnvironmentSection(v, c);
}

void describeSensors(ConfigVisitor& v) {
  SensorParameters p;
  p.describe(v);
}

}  // namespace ballbot
