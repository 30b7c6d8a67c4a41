#pragma once

#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "core/random.hpp"
#include "core/yaml_file.hpp"
#include "plant/multibody.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {

/// A scenario of the example robot on configs/plants/<plant>.yaml, with overrides as for --set.
inline ConfigNode plantScenario(const std::string& plant,
                                const std::vector<std::string>& overrides = {}) {
  const std::string configs = BALLBOT_SOURCE_DIR "/configs/";
  ConfigNode tree = ConfigNode::map({"test", 0, 0});
  tree.set("robot", loadYamlFile(configs + "robots/ballbot.yaml"));
  tree.set("plant", loadYamlFile(configs + "plants/" + plant + ".yaml"));
  for (const std::string& text : overrides) applyOverride(tree, text);
  return tree;
}

inline PlantConfig plantConfig(const std::string& plant,
                               const std::vector<std::string>& overrides = {}) {
  return readPlantConfig(plantScenario(plant, overrides));
}

inline RobotParameters exampleRobot() { return plantConfig("ideal").robot; }

inline MultibodyOptions multibodyOptions(MultibodyStructure structure, bool rotors,
                                         bool ball_spin = false) {
  MultibodyOptions o;
  o.structure = structure;
  o.rotors = rotors;
  o.ball_spin = ball_spin;
  return o;
}

/// A state and what acts on it, as in hard use; repeatable by index.
struct RandomMotion {
  RobotPose pose;
  VelocityVector nu;
  double ball_spin;
  MultibodyLoads loads;
};

inline RandomMotion randomMotion(int index) {
  const RandomStream stream(7, "plant_test");
  int k = 0;
  const auto uniform = [&] {  // in (-1, 1)
    const double u = stream.uniforms(static_cast<std::uint64_t>(index), k / 4)[k % 4];
    ++k;
    return 2 * u - 1;
  };
  RandomMotion m;
  m.pose = {uniform(), uniform(), 3 * uniform(), 0.6 * uniform(), 0.6 * uniform(), Vector3::Zero()};
  for (double& angle : m.pose.arm) angle = 2 * uniform();
  for (double& rate : m.nu) rate = 2 * uniform();
  m.ball_spin = 2 * uniform();
  for (double& torque : m.loads.joint_torque) torque = 10 * uniform();
  for (double& torque : m.loads.rotor_torque) torque = 10 * uniform();
  for (int body = kBallBody; body < kBodyCount; ++body) {
    const Vector3 point(0.2 * uniform(), 0.2 * uniform(), 0.2 * uniform());
    const Vector3 force(20 * uniform(), 20 * uniform(), 20 * uniform());
    m.loads.forces.push_back({static_cast<BodyIndex>(body), point, force});
  }
  return m;
}

/// y of `robot` in that motion.
inline std::vector<double> stateOf(const Multibody& robot, const RandomMotion& m) {
  std::vector<double> y(robot.stateDim(), 0.0);
  robot.place(m.pose, y.data());
  robot.setVelocity(m.nu, m.ball_spin, y.data());
  return y;
}

}  // namespace ballbot
