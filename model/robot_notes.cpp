#include "model/robot_notes.hpp"

#include "core/config_node.hpp"
#include "model/robot_reader.hpp"
#include "model/urdf_loader.hpp"

namespace ballbot {

std::vector<std::string> robotNotes(const ConfigNode& robot) {
  const ConfigNode* urdf = robot.find("urdf");
  if (!urdf) return {};
  return loadUrdf(urdfPath(*urdf)).notes;
}

}  // namespace ballbot
