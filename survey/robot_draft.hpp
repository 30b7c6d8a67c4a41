#pragma once

#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "model/robot_links.hpp"

namespace ballbot {

/// The `robot:` description of a URDF that has none yet: the wheels are where the URDF has them,
/// masses add up, drives keep the URDF's limits. What no URDF can say is left to another
/// description, on which this one is laid.
class RobotDraft {
 public:
  /// @throw InputError as loadUrdf, and for wheels that no description can have.
  RobotDraft(const std::string& urdf, const RobotLinks& links);

  /// That other description with these keys on top.
  ConfigNode laidOn(ConfigNode description) const;
  /// The same as text of a YAML file that includes it.
  /// @param urdf, description  their paths as seen from that file
  std::string text(const std::string& urdf, const std::string& description) const;

 private:
  struct Key {
    std::string path, value;  ///< value as YAML
    const char* words;
  };
  void addDrives(const char* group, double torque, double speed);

  std::string urdf_;
  std::vector<Key> keys_;
  std::vector<Key> drives_;  ///< below `actuators`
};

}  // namespace ballbot
