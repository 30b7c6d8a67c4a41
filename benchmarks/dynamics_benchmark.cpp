#include <vector>

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

/// One state by itself, as in a rollout.
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

/// Many states in one call; the time given is per state.
class Nodes {
 public:
  explicit Nodes(int count) : x(count, movingState()), tau(count, kTorque), lambda(count, kForce) {
    for (int i = 0; i < count; ++i) x[i][kPitch] += 1e-3 * i;
  }
  std::vector<StateVector> x;
  std::vector<JointVector> tau;
  std::vector<Vector3> lambda;
};

void reportTimePerState(benchmark::State& state, int count) {
  state.counters["per_state"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * count,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void dynamics_batch(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const ReducedDynamics model(exampleRobot());
  Nodes nodes(count);
  std::vector<StateVector> dx(count);
  for (auto _ : state) {
    benchmark::DoNotOptimize(nodes.x.data());
    model.derivatives(count, nodes.x.data(), nodes.tau.data(), nodes.lambda.data(), dx.data());
    benchmark::ClobberMemory();
  }
  reportTimePerState(state, count);
}
BENCHMARK(dynamics_batch)->Arg(4);

void dynamics_derivatives(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const ReducedDynamics model(exampleRobot());
  Nodes nodes(count);
  std::vector<ReducedDynamics::Linearization> lin(count);
  for (auto _ : state) {
    benchmark::DoNotOptimize(nodes.x.data());
    model.linearize(count, nodes.x.data(), nodes.tau.data(), nodes.lambda.data(), lin.data(),
                    nullptr);
    benchmark::ClobberMemory();
  }
  reportTimePerState(state, count);
}
BENCHMARK(dynamics_derivatives)->Arg(1)->Arg(4)->Arg(100);

void dynamics_and_end_effector_derivatives(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const ReducedDynamics model(exampleRobot());
  Nodes nodes(count);
  std::vector<ReducedDynamics::Linearization> lin(count);
  std::vector<ReducedDynamics::EndEffectorLinearization> tip(count);
  for (auto _ : state) {
    benchmark::DoNotOptimize(nodes.x.data());
    model.linearize(count, nodes.x.data(), nodes.tau.data(), nodes.lambda.data(), lin.data(),
                    tip.data());
    benchmark::ClobberMemory();
  }
  reportTimePerState(state, count);
}
BENCHMARK(dynamics_and_end_effector_derivatives)->Arg(100);

}  // namespace
}  // namespace ballbot
