#include "experiment/scenario_keys.hpp"

#include <fmt/format.h>

#include "controller/controller_settings.hpp"
#include "core/angle.hpp"
#include "estimator/estimator_registry.hpp"
#include "experiment/recording.hpp"
#include "experiment/scenario.hpp"
#include "model/robot_reader.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {
namespace {

/// One that balances: defaults of the controller are made for a robot. Its torque limits and pose
/// at rest stand where a scenario's own robot has others.
RobotParameters plainRobot() {
  RobotParameters robot;
  robot.ball = {0.125, 4, 0.04};
  robot.wheels.radius = 0.05;
  robot.wheels.mass = 0.5;
  robot.wheels.spin_inertia = robot.wheels.transverse_inertia = 1e-3;
  robot.wheels.contact_zenith = 45 * kRadPerDeg;
  robot.wheels.azimuth = {0, 120 * kRadPerDeg, -120 * kRadPerDeg};
  const auto body = [](double mass, double height) {
    return BodyInertia{mass, height * Vector3::UnitZ(), 0.1 * mass * Matrix3::Identity()};
  };
  robot.base = body(15, 0.3);
  for (int i = 0; i < kArmJointCount; ++i) {
    ArmLink& link = robot.arm[i];
    link.name = fmt::format("arm_{}", i + 1);
    link.p_PJ_P = 0.2 * Vector3::UnitZ();
    link.axis = Vector3::UnitY();
    link.inertia = body(1, 0.1);
    link.lower_limit = -3;
    link.upper_limit = 3;
  }
  robot.arm[0].axis = Vector3::UnitZ();
  robot.p_A3E = 0.2 * Vector3::UnitZ();
  robot.wheel_torque_limit = 4;
  robot.arm_torque_limit = 18;
  return robot;
}

void describeScenario(ConfigVisitor& v) {
  Scenario s;
  s.describe(v);
  v.section(must("robot", "what it is made of"), [](ConfigVisitor& in) {
    describeRobot(in);
    in.section(may("sensors", "figures of its sensors"), describeSensors);
  });
  v.section(must("plant", "how the robot is simulated"), describePlant);
  v.section(must("estimator", "how the controller makes a state of measurements"),
            describeEstimator);
  v.section(must("controller", "what makes commands of states"),
            [](ConfigVisitor& in) { describeController(in, plainRobot()); });
  v.section(may("rates", "how often each part of the controller runs"),
            [&](ConfigVisitor& in) { s.rates.describe(in); });
  v.section(may("initial", "where the run begins"), describeInitial);
  v.section(may("environment", "pushes, a door, a wall, a payload"), describeEnvironment);
  v.section(may("recording", "what goes into the log, and how often"),
            [](ConfigVisitor& in) { Recording().describe(in); });
  v.other(may("requirements", "what the run must reach to pass"),
          "mapping from metrics to {below: number, above: number}", [](ConfigReader&) {});
  v.other(may("fmus", "other people's models, in the plant's place or connected to it"),
          "list of {name, file, parameters, connections}, see docs/fmu.md", [](ConfigReader&) {});
}

}  // namespace

const KeyBook& scenarioKeys() {
  static const KeyBook book = [] {
    ConfigListing listing;
    describeScenario(listing);
    return KeyBook{"scenario", listing.take()};
  }();
  return book;
}

}  // namespace ballbot
