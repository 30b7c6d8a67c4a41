// How many cases of the smoke study a core does in a minute, and which share of the time goes into
// runs rather than into the study around them. It reads timing.json, as a person would.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

void study(benchmark::State& state) {
  namespace fs = std::filesystem;
  const std::string out =
      (fs::temp_directory_path() / ("ballbot_study_" + std::to_string(::getpid()))).string();
  const std::string command = std::string(BALLBOT_BIN_DIR) + "/ballbot study " +
                              BALLBOT_SOURCE_DIR + "/configs/studies/smoke.yaml --quiet --out " +
                              out + " --jobs " + std::to_string(state.range(0)) + " >/dev/null";
  for (auto _ : state) {
    fs::remove_all(out);
    if (std::system(command.c_str()) != 0) {
      state.SkipWithError("a case did not run");
      break;
    }
    std::ifstream file(out + "/timing.json");
    const auto timing = nlohmann::json::parse(file);
    state.SetIterationTime(timing.at("wall_s"));
    state.counters["cases_per_minute_per_core"] =
        timing.at("cases_per_minute_per_core").get<double>();
    state.counters["share_of_cpu_in_runs"] = timing.at("share_of_cpu_in_runs").get<double>();
  }
  fs::remove_all(out);
}

BENCHMARK(study)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("jobs")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
