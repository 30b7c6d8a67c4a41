#include "experiment/believed_robot.hpp"

#include "core/config_reader.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {

RobotParameters believedRobot(const Scenario& scenario) {
  ConfigReader robot_in(scenario.section("robot"), "robot");
  RobotParameters robot = readRobot(robot_in);
  ConfigReader in(scenario.section("controller"), "controller");
  robot.payload_mass = in.numberOr("known_payload_kg", robot.payload_mass, {0, 5});
  return robot;
}

}  // namespace ballbot
