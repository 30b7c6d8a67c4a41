#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cosim/lcm_transport.hpp"
#include "cosim/serve.hpp"
#include "experiment/plant_link.hpp"
#include "hil/bench_check.hpp"
#include "hil/hil_participant.hpp"
#include "hil/open_can_bus.hpp"
#include "hil/realtime_runner.hpp"
#include "hil/record_writer.hpp"
#include "hil/rehearsal/fault_table.hpp"
#include "hil/stepped_runner.hpp"
#include "report/json_text.hpp"
#include "tools/bench_report.hpp"
#include "tools/bench_scenario.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

struct HilArguments {
  std::string config;
  std::vector<std::string> overrides;
  std::string lcm_url = sharedLcmAddress().url, channel = sharedLcmAddress().channel;
  std::string record;
  bool faults = false, check = false, keep_serving = false, json = false;
};

ExitCode showFaults(bool json) {
  const std::vector<FaultRow> rows = rehearseFaults();
  bool held = true;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  if (!json) {
    fmt::print("{:<4} {:<54} {:<26} {:>5} {:>6}  {}\n", "", "fault", "expected", "bound", "cycles",
               "what the bench said");
  }
  for (const FaultRow& r : rows) {
    held = held && r.held;
    list.push_back({{"name", r.fault},
                    {"expected", r.expected},
                    {"bound_cycles", r.bound_cycles},
                    {"measured_cycles", r.measured_cycles},
                    {"reason", r.reason},
                    {"held", r.held}});
    if (json) continue;
    fmt::print("{:<4} {:<54} {:<26} {:>5} {:>6}  {}\n", r.held ? "ok" : "MISS", r.fault, r.expected,
               r.bound_cycles, r.measured_cycles, r.reason);
  }
  if (json) fmt::print("{}\n", jsonText(nlohmann::ordered_json{{"rows", list}, {"held", held}}));
  return held ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

void requireFreeAddress(const LcmAddress& address) {
  LcmTransport master_end(address, LinkEnd::kMaster);
  if (const auto who = whoServes(master_end)) {
    throw InputError("'" + *who + "' already serves " + master_end.describe() +
                     ". Give this one another --channel, or end that one first");
  }
}

/// The buses a bench file names, opened.
struct OpenBuses {
  explicit OpenBuses(const BenchConfig& config) {
    for (const BusConfig& bus : config.buses) {
      owned.push_back(openCanBus(bus.address, bus.bitrate_kbps));
      ends.push_back(owned.back().get());
      fmt::print(stderr, "hil: {}\n", owned.back()->describe());
    }
  }
  std::vector<std::unique_ptr<CanBus>> owned;
  std::vector<CanBus*> ends;
};

ExitCode showBench(const HilArguments& a) {
  const BenchConfig config = readBenchConfig(loadBenchTree(a.config, a.overrides));
  const OpenBuses buses(config);
  const auto nodes = checkBench(config, buses.ends, std::chrono::milliseconds(200));
  fmt::print("{}", a.json ? jsonText(checkJson(nodes)) + "\n" : checkTable(nodes));
  return allGood(nodes) ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

ServeReport serveRunner(BenchRunner& runner, const HilArguments& a, std::uint64_t digest) {
  HilParticipant participant(runner);
  LcmTransport transport({a.lcm_url, a.channel}, LinkEnd::kParticipant);
  ServeOptions options;
  options.config_digest = digest;
  options.stop = interruptFlag();
  options.keep_serving = a.keep_serving;
  options.say = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
  return serve(participant, transport, options);
}

ExitCode serveBench(const HilArguments& a) {
  const BenchConfig config = readBenchConfig(loadBenchTree(a.config, a.overrides));
  const std::uint64_t digest = configDigest64(loadBenchScenario(config, a.config));
  requireFreeAddress({a.lcm_url, a.channel});
  const OpenBuses buses(config);
  fmt::print(stderr,
             "hil: this program is no emergency stop. Keep the hardware one (STO) within reach.\n");
  nlohmann::ordered_json report;
  ServeReport served;
  std::string fault;
  if (config.stepped) {
    SteppedRunner runner(config, buses.ends);
    served = serveRunner(runner, a, digest);
    runner.release();
    fault = runner.bench().faultText();
    report = benchJson(runner.bench(), runner.io());
  } else {
    RealtimeRunner runner(config, buses.ends);
    {
      RecordWriter writer(runner.records(), a.record);
      served = serveRunner(runner, a, digest);
      runner.finish();
    }
    fault = runner.bench().faultText();
    report = benchJson(runner.bench(), runner.io());
    report["realtime"] = realtimeJson(runner.statistics());
  }
  fmt::print("{}", a.json ? jsonText(report) + "\n" : benchText(report));
  if (!fault.empty()) throw LostParticipantError("bench", "hil: " + fault);
  return served.end == ServeEnd::kInterrupted ? ExitCode::kInterrupted : ExitCode::kPassed;
}

}  // namespace

void addHilCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "hil", "Serve a bench of real or emulated drives over LCM, in the plant's place");
  const auto a = std::make_shared<HilArguments>();
  command->add_option("config", a->config, "Bench file, e.g. configs/hil/bench.yaml");
  command->add_option("--set", a->overrides, "path=value: change one value of the bench file")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--lcm-url", a->lcm_url, "LCM URL; ttl=0 keeps packets on this machine")
      ->capture_default_str();
  command->add_option("--channel", a->channel, "LCM channel")->capture_default_str();
  command->add_flag("--keep-serving", a->keep_serving, "Serve run after run until Ctrl-C");
  command->add_option("--record", a->record, "Write every cycle to this CSV file (real time only)");
  command->add_flag("--check", a->check,
                    "Ask every node what it is, change nothing, print a table and what disagrees");
  command->add_flag("--faults", a->faults,
                    "Try every fault on emulated drives in this process and print the table");
  command->add_flag("--json", a->json, "Print results as JSON");
  command->footer(
      "Example, three terminals:\n"
      "  ballbot drives configs/hil/bench.yaml\n"
      "  ballbot hil configs/hil/bench.yaml\n"
      "  ballbot controller configs/scenarios/bench_balance.yaml\n"
      "Software is no emergency stop: docs/hil.md.\n"
      "Exit codes: 0 the run ended, 1 a fault did not end as it must (--faults), 2 bad input,\n"
      "3 the bench stopped or the controller was lost, 130 interrupted.");
  command->callback([&result, a] {
    if (a->faults) {
      result = showFaults(a->json);
      return;
    }
    if (a->config.empty()) throw InputError("hil: give a bench file, e.g. configs/hil/bench.yaml");
    result = a->check ? showBench(*a) : serveBench(*a);
  });
}

}  // namespace ballbot
