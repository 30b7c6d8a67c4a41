#include "model/robot_urdf.hpp"

#include "core/config_visitor.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {

RobotUrdf readRobotUrdf(const ConfigNode& robot) {
  RobotUrdf out;
  ConfigReader in(robot, "robot");
  if (in.has("links")) {
    ConfigReader links = in.child("links");
    readDescribed(links, out.links);
    links.finish();
  }
  out.read = loadUrdf(urdfPath(*in.raw("urdf")), out.links);
  return out;
}

}  // namespace ballbot
