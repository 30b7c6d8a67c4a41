// How much faster than real time a whole run is: plant process, controller process, LCM between
// them, recording and digest. It calls the program as a person would and reads timing.json, so that
// start-up and report do not count.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

void cosimulation(benchmark::State& state, const std::string& options) {
  namespace fs = std::filesystem;
  const std::string out =
      (fs::temp_directory_path() / ("ballbot_benchmark_" + std::to_string(::getpid()))).string();
  const std::string command = std::string(BALLBOT_BIN_DIR) + "/ballbot run " + BALLBOT_SOURCE_DIR +
                              "/configs/scenarios/balance.yaml --quiet --no-report --out " + out +
                              " " + options + " >/dev/null";
  double factor = 0;
  for (auto _ : state) {
    fs::remove_all(out);
    if (std::system(command.c_str()) != 0) {
      state.SkipWithError("the run did not pass");
      break;
    }
    std::ifstream timing(out + "/timing.json");
    const double seconds = nlohmann::json::parse(timing).at("wall_s");
    factor = 10 / seconds;
    state.SetIterationTime(seconds);
  }
  fs::remove_all(out);
  state.counters["times_real_time"] = factor;
}

// One run is long enough to be measured by itself.
BENCHMARK_CAPTURE(cosimulation, full_lcm, "")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(cosimulation, full_in_process, "--in-process")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(cosimulation, reduced_wheels_lcm, "--set plant.fidelity.multibody=reduced_wheels")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
