// What the FMI layer adds to a step of the plant, and what a process of its own adds to that.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "core/yaml_file.hpp"
#include "fmi/fmi3_library.hpp"
#include "fmi/fmu_description.hpp"
#include "fmi/fmu_export.hpp"
#include "fmi/fmu_process.hpp"
#include "fmi/zip_archive.hpp"
#include "plant/plant.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;
using WallClock = std::chrono::steady_clock;

constexpr SimDuration kStep{400'000};
constexpr int kStepsBetweenRestarts = 500;  // the robot is not balanced: do not let it fall

ConfigNode scenario() { return loadYamlFile(BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml"); }

/// The exported plant, for FMI 3, below the temporary folder.
struct Exported {
  fs::path folder = fs::temp_directory_path() / ("fmu_benchmark" + std::to_string(::getpid()));
  std::string file = folder / "plant.fmu";
  FmuDescription description;

  Exported() {
    fs::create_directories(folder);
    FmuExport how;
    how.fmi_version = 3;
    how.libraries_folder = BALLBOT_BIN_DIR "/../lib/ballbot/fmu";
    exportFmu(scenario(), BALLBOT_SOURCE_DIR "/configs/robots/ballbot.urdf", how, file);
    unpackZip(file, folder);
    description = readFmuDescription(file);
  }
  ~Exported() { fs::remove_all(folder); }
  fmi3ValueReference reference(const char* name) const { return description.find(name)->reference; }
};
const Exported& exported() {
  static const Exported fmu;
  return fmu;
}

/// An instance that is stepped as an importer does: set the torques, step, get all sensors.
class Importer {
 public:
  Importer() {
    instance_ = fmu_.fmi3InstantiateCoSimulation(
        "one", exported().description.token.c_str(), (exported().folder / "resources/").c_str(),
        false, false, false, false, nullptr, 0, nullptr, nullptr, nullptr);
    for (const char* name : {"sensors.motor_angle", "sensors.joint_angle", "sensors.joint_velocity",
                             "sensors.joint_torque", "sensors.accel_B", "sensors.gyro_WB_B"}) {
      sensors_.push_back(exported().reference(name));
    }
    restart();
  }
  ~Importer() { fmu_.fmi3FreeInstance(instance_); }

  void restart() {
    fmu_.fmi3Reset(instance_);
    fmu_.fmi3EnterInitializationMode(instance_, false, 0, 0, false, 0);
    fmu_.fmi3ExitInitializationMode(instance_);
    steps_ = 0;
  }
  bool set(const double* torque) {
    return fmu_.fmi3SetFloat64(instance_, &torque_, 1, torque, 6) == fmi3OK;
  }
  bool get() {
    return fmu_.fmi3GetFloat64(instance_, sensors_.data(), sensors_.size(), values_, 30) == fmi3OK;
  }
  bool step(const double* torque) {
    bool event = false, end = false, early = false;
    double reached = 0;
    return set(torque) &&
           fmu_.fmi3DoStep(instance_, 4e-4 * steps_++, 4e-4, true, &event, &end, &early,
                           &reached) == fmi3OK &&
           get();
  }

 private:
  Fmi3Library fmu_{(exported().folder / exported().description.binaryPath()).string()};
  fmi3Instance instance_ = nullptr;
  fmi3ValueReference torque_ = exported().reference("command.torque");
  std::vector<fmi3ValueReference> sensors_;
  double values_[30] = {};
  int steps_ = 0;
};

double microseconds(WallClock::duration d) {
  return std::chrono::duration<double, std::micro>(d).count();
}

/// The same steps of the native plant and of the FMU in turn, so that both meet the same moods of
/// the machine; the counters are medians [us].
void fmuStep(benchmark::State& state) {
  Plant plant(readPlantConfig(scenario()));
  Importer fmu;
  ActuatorCommand command;
  command.torque << 0.2, -0.1, -0.1, 0, 0, 0;
  std::vector<double> native, imported, difference;
  int steps = 0;
  for (auto _ : state) {
    if (++steps % kStepsBetweenRestarts == 0) {
      state.PauseTiming();
      plant.reset(kSimStart);
      fmu.restart();
      state.ResumeTiming();
    }
    // By turns the one and the other first: who comes second finds warmer caches.
    WallClock::duration plant_time{}, fmu_time{};
    for (int turn = 0; turn < 2; ++turn) {
      const auto begun = WallClock::now();
      if ((steps + turn) % 2 == 0) {
        plant.advanceTo(plant.now() + kStep, command);
        plant_time = WallClock::now() - begun;
      } else {
        if (!fmu.step(command.torque.data())) state.SkipWithError("the FMU returned an error");
        fmu_time = WallClock::now() - begun;
      }
    }
    native.push_back(microseconds(plant_time));
    imported.push_back(microseconds(fmu_time));
    difference.push_back(imported.back() - native.back());
  }
  const auto median = [](std::vector<double>& v) {
    const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
  };
  state.counters["native_us"] = median(native);
  state.counters["fmu_us"] = median(imported);
  state.counters["overhead_us"] = median(difference);
}
BENCHMARK(fmuStep)->Name("fmu_step/native_and_fmu");

/// What an importer calls beside doStep.
void fmuCalls(benchmark::State& state) {
  Importer fmu;
  const double torque[6] = {0.1, 0.1, 0.1, 0, 0, 0};
  for (auto _ : state) {
    if (!fmu.set(torque) || !fmu.get()) state.SkipWithError("the FMU returned an error");
  }
}
BENCHMARK(fmuCalls)->Name("fmu_set_and_get");

/// Set and get without a step, by way of a process of its own.
void fmuRoundTrip(benchmark::State& state) {
  FmuUse use;
  use.name = "plant";
  use.file = exported().file;
  use.inputs = {"command.torque"};
  use.outputs = {"sensors.motor_angle", "sensors.gyro_WB_B"};
  FmuProcess fmu(use, BALLBOT_BIN_DIR "/ballbot");
  fmu.initialize(kSimStart);
  const std::vector<double> torque(6, 0.1);
  for (auto _ : state) fmu.evaluate(torque);
}
BENCHMARK(fmuRoundTrip)->Name("fmu_process_round_trip");

}  // namespace
}  // namespace ballbot
