// One communication step of 0.4 ms of the plant, full fidelity unless said otherwise, by structure.
#include <benchmark/benchmark.h>

#include "core/yaml_file.hpp"
#include "plant/plant.hpp"

namespace ballbot {
namespace {

constexpr SimDuration kStep{400'000};
constexpr int kStepsBetweenRestarts = 500;  // the robot is not balanced: do not let it fall

PlantConfig configOf(const char* plant, const std::string& fidelity) {
  const std::string configs = BALLBOT_SOURCE_DIR "/configs/";
  ConfigNode tree = ConfigNode::map({"benchmark", 0, 0});
  tree.set("robot", loadYamlFile(configs + "robots/ballbot.yaml"));
  tree.set("plant", loadYamlFile(configs + "plants/" + plant + ".yaml"));
  applyOverride(tree, "plant.fidelity." + fidelity);
  applyOverride(tree, "initial={pitch_deg: 1.2}");
  return readPlantConfig(tree);
}

/// The arm held by the drives' PD, the wheels busy.
ActuatorCommand holdArm(const PlantConfig& config) {
  ActuatorCommand c;
  c.torque << 0.2, -0.1, -0.1, 0, 0, 0;
  c.position.tail<3>() = config.robot.nominal_arm;
  c.stiffness.tail<3>().setConstant(60);
  c.damping.tail<3>().setConstant(3);
  return c;
}

void plantStep(benchmark::State& state, const char* plant_file, const char* fidelity) {
  const PlantConfig config = configOf(plant_file, fidelity);
  Plant plant(config);
  const ActuatorCommand command = holdArm(config);
  int steps = 0;
  for (auto _ : state) {
    if (++steps % kStepsBetweenRestarts == 0) plant.reset(kSimStart);
    plant.advanceTo(plant.now() + kStep, command);
    benchmark::DoNotOptimize(plant.sensors().joint_angle.data());
  }
  state.counters["times_real_time"] = benchmark::Counter(
      toSeconds(kStep) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(plantStep, R, "full", "multibody=full")->Name("plant_step/R");
BENCHMARK_CAPTURE(plantStep, R_slip, "full", "wheels=slipping")->Name("plant_step/R_slip");
BENCHMARK_CAPTURE(plantStep, M, "full", "multibody=reduced_wheels")->Name("plant_step/M");
BENCHMARK_CAPTURE(plantStep, R_ideal, "ideal", "multibody=full")->Name("plant_step/R_ideal");
BENCHMARK_CAPTURE(plantStep, M_ideal, "ideal", "multibody=reduced_wheels")
    ->Name("plant_step/M_ideal");

void plantSave(benchmark::State& state) {
  Plant plant(configOf("full", "multibody=full"));
  for (auto _ : state) benchmark::DoNotOptimize(plant.saveState());
}
BENCHMARK(plantSave)->Name("plant_save");

void plantDigest(benchmark::State& state) {
  Plant plant(configOf("full", "multibody=full"));
  for (auto _ : state) benchmark::DoNotOptimize(plant.stateDigest());
}
BENCHMARK(plantDigest)->Name("plant_digest");

}  // namespace
}  // namespace ballbot
