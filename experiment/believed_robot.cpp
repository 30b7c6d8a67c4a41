#include "experiment/believed_robot.hpp"

#include "controller/law_factory.hpp"
#include "core/config_visitor.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {

RobotParameters scenarioRobot(const Scenario& scenario) {
  ConfigReader in(scenario.section("robot"), "robot");
  return readRobot(in);
}

RobotParameters believedRobot(const Scenario& scenario) {
  RobotParameters robot = scenarioRobot(scenario);
  ConfigReader in(scenario.section("controller"), "controller");
  ConfigReading reading(in);
  describeKnownPayload(reading, robot.payload_mass);
  return robot;
}

}  // namespace ballbot
