#include "experiment/believed_robot.hpp"

#include "core/config_reader.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {

RobotParameters scenarioRobot(const Scenario& scenario) {
  ConfigReader in(scenario.section("robot"), "robot");
  return readRobot(in);
}

RobotParameters believedRobot(const Scenario& scenario) {
  RobotParameters robot = scenarioRobot(scenario);
  ConfigReader in(scenario.section("controller"), "controller");
  robot.payload_mass = in.numberOr("known_payload_kg", robot.payload_mass, {0, 5});
  return robot;
}

}  // namespace ballbot
