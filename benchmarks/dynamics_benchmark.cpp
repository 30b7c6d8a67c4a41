#include <benchmark/benchmark.h>

#include "core/config_reader.hpp"
#include "core/yaml_file.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {
namespace {

RobotParameters exampleRobot() {
  const ConfigNode tree = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/robots/ballbot.yaml");
  ConfigReader in(tree, "robot");
  return readRobot(in);
}

/// A state far from rest, so that no term is zero.
StateVector movingState() {
  StateVector x;
  x << 0.1, -0.2, 0.3, 0.05, -0.08, 0.4, -0.5, 2, 0.2, -0.1, 0.3, -0.4, 0.5, 0.6, -0.7, 0.8;
  return x;
}

const JointVector kTorque = (JointVector() << 1, -0.5, 0.3, 2, -1, 0.5).finished();
const Vector3 kForce(-5, 1, 2);

void dynamics(benchmark::State& state) {
  const ReducedDynamics model(exampleRobot());
  StateVector x = movingState();
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    StateVector dx = model.derivative(x, kTorque, kForce);
    benchmark::DoNotOptimize(dx);
  }
}
BENCHMARK(dynamics);

void dynamics_derivatives(benchmark::State& state) {
  const ReducedDynamics model(exampleRobot());
  StateVector x = movingState();
  ReducedDynamics::Linearization lin;
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    model.linearize(x, kTorque, kForce, lin);
    benchmark::DoNotOptimize(lin);
  }
}
BENCHMARK(dynamics_derivatives);

}  // namespace
}  // namespace ballbot
