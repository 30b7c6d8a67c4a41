#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/angle.hpp"
#include "experiment/plant_factory.hpp"
#include "experiment/scenario.hpp"
#include "hil/bench_config.hpp"
#include "hil/emulator/elastic_rig.hpp"
#include "hil/emulator/joint_rig.hpp"
#include "hil/emulator/serve_drives.hpp"
#include "hil/open_can_bus.hpp"
#include "hil/realtime_thread.hpp"
#include "report/json_text.hpp"
#include "tools/bench_scenario.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

// Below that of `ballbot hil`, which must be on time even if the drives are not.
constexpr int kEmulatorPriority = 70;

struct DrivesArguments {
  std::string config;
  std::vector<std::string> overrides;
  bool json = false;
};

std::unique_ptr<Participant> robotBehind(const EmulatorConfig& emulator, const BenchConfig& bench,
                                         const std::string& path) {
  if (emulator.elastic_rig) return std::make_unique<ElasticRig>(*emulator.elastic_rig);
  if (!emulator.rig) return makePlant(readPlantSetup(loadBenchScenario(bench, path)));
  JointRigOptions rig;
  rig.bandwidth_Hz = emulator.rig_bandwidth_Hz;
  rig.damping_ratio = emulator.rig_damping_ratio;
  rig.delay_s = 1e-3 * emulator.rig_delay_ms;
  rig.blocked = emulator.rig_blocked;
  return std::make_unique<JointRig>(rig);
}

ExitCode emulateDrives(const DrivesArguments& a) {
  const ConfigNode tree = loadBenchTree(a.config, a.overrides);
  const EmulatorConfig config = readEmulatorConfig(tree);
  EmulatedBench bench(config, robotBehind(config, readBenchConfig(tree), a.config));
  // The rates of a kernel's interface are set where it is set up; this one stands in an error's
  // text.
  CanBusSettings settings;
  if (config.flexible) settings.data_bitrate_kbps = 5000;
  const auto buses = openEmulatedBuses(
      config, [&](const std::string& address) { return openCanBus(address, settings); });
  for (const auto& bus : buses) fmt::print(stderr, "{}\n", bus->describe());
  fmt::print(stderr, "six drives and an IMU are powered on; {}. Ctrl-C ends.\n",
             config.stepped ? "SYNC is their clock" : "in real time");
  if (!config.stepped) {
    fmt::print(stderr, "drives: {}\n", becomeRealtime(kEmulatorPriority).text);
  }
  serveDrives(bench, config, buses, interruptFlag());
  if (a.json) {
    nlohmann::ordered_json out;
    out["syncs"] = bench.syncs();
    out["robot_s"] = bench.robotSeconds();
    out["largest_tilt_deg"] = bench.largestTilt() * kDegPerRad;
    out["torque_on"] = bench.anyEnergized();
    fmt::print("{}\n", jsonText(out));
  }
  return ExitCode::kPassed;
}

}  // namespace

void addDrivesCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "drives", "Emulate six CiA 402 drives and an IMU on pty or SocketCAN, the robot behind them");
  const auto a = std::make_shared<DrivesArguments>();
  command->add_option("config", a->config, "Bench file, e.g. configs/hil/bench.yaml")->required();
  command->add_option("--set", a->overrides, "path=value: change one value of the bench file")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_flag("--json", a->json, "Print at the end how far the robot came and how it stood");
  command->footer(
      "Example, three terminals:\n"
      "  ballbot drives configs/hil/bench.yaml\n"
      "  ballbot hil configs/hil/bench.yaml\n"
      "  ballbot controller configs/scenarios/bench_balance.yaml\n"
      "Exit codes: 0 ended by Ctrl-C, 2 bad input, 4 no pty.");
  command->callback([&result, a] { result = emulateDrives(*a); });
}

}  // namespace ballbot
