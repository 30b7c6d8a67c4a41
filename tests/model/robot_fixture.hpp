#pragma once

#include <string>

#include "core/config_reader.hpp"
#include "core/random.hpp"
#include "core/yaml_file.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {

inline std::string robotFile() { return BALLBOT_SOURCE_DIR "/configs/robots/ballbot.yaml"; }

inline RobotParameters exampleRobot() {
  const ConfigNode tree = loadYamlFile(robotFile());
  ConfigReader in(tree, "robot");
  return readRobot(in);
}

/// A state, torques and a force as they occur in hard use, repeatable by index.
struct RandomCase {
  StateVector x;
  JointVector tau;
  Vector3 lambda;
};

inline RandomCase randomCase(int index) {
  const RandomStream stream(42, "model_test");
  RandomCase c;
  const auto uniform = [&](int k) {  // in (-1, 1)
    return 2 * stream.uniforms(index, k / 4)[k % 4] - 1;
  };
  for (int i = 0; i < kStateDim; ++i) c.x[i] = 2 * uniform(i);
  c.x[kYaw] *= 1.5;
  c.x.segment<2>(kPitch) *= 0.4;
  for (int i = 0; i < kJointCount; ++i) c.tau[i] = 10 * uniform(kStateDim + i);
  for (int i = 0; i < 3; ++i) c.lambda[i] = 20 * uniform(kStateDim + kJointCount + i);
  return c;
}

}  // namespace ballbot
