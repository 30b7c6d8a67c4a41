#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cosim/lcm_transport.hpp"
#include "cosim/serve.hpp"
#include "experiment/plant_link.hpp"
#include "hil/bench_check.hpp"
#include "hil/bus_budget.hpp"
#include "hil/data_sheet_check.hpp"
#include "hil/hil_participant.hpp"
#include "hil/latency/kernel_floor.hpp"
#include "hil/open_can_bus.hpp"
#include "hil/realtime_runner.hpp"
#include "hil/record_writer.hpp"
#include "hil/rehearsal/fault_table.hpp"
#include "hil/stepped_runner.hpp"
#include "report/json_text.hpp"
#include "tools/bench_record.hpp"
#include "tools/bench_report.hpp"
#include "tools/bench_scenario.hpp"
#include "tools/bench_tables.hpp"
#include "tools/commands.hpp"
#include "tools/commission_bench.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

struct HilArguments {
  std::string config;
  std::vector<std::string> overrides;
  std::string lcm_url = sharedLcmAddress().url, channel = sharedLcmAddress().channel;
  std::string record, show_record, commissioning_record, person, without_commissioning;
  bool commission = false, rehearse = false;
  RecordOptions records;
  double floor_s = 1;
  bool floor_meanwhile = false;
  bool faults = false, checks = false, check = false, budget = false, keep_serving = false,
       json = false;
  int random = 0;
  std::uint64_t seed = 1;
};

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
      owned.push_back(openCanBus(bus.address, bus.settings));
      ends.push_back(owned.back().get());
      fmt::print(stderr, "hil: {}\n", owned.back()->describe());
    }
  }
  std::vector<std::unique_ptr<CanBus>> owned;
  std::vector<CanBus*> ends;
};

ExitCode showBench(const HilArguments& a) {
  const BenchConfig config = readBenchConfig(loadBenchTree(a.config, a.overrides));
  const std::vector<std::string> sheets = checkDataSheets(config);
  const OpenBuses buses(config);
  const auto nodes = checkBench(config, buses.ends);
  fmt::print("{}", a.json ? jsonText(checkJson(nodes, sheets)) + "\n" : checkTable(nodes, sheets));
  return allGood(nodes) && sheets.empty() ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

ExitCode showBudget(const HilArguments& a) {
  const BenchConfig config = readBenchConfig(loadBenchTree(a.config, a.overrides));
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  int bus = 0;
  for (const BusBudget& b : busBudget(config)) {
    list.push_back({{"frames_per_cycle", b.frames_per_cycle},
                    {"nominal", b.nominal},
                    {"worst_stuffing", b.worst}});
    if (a.json) continue;
    fmt::print(
        "bus {}: {} frames in every cycle of {:.6g} ms: load {:.0f} %, {:.0f} % with the most "
        "stuffing\n",
        bus++, b.frames_per_cycle, 1e3 * config.cycleSeconds(), 100 * b.nominal, 100 * b.worst);
  }
  if (a.json) fmt::print("{}\n", jsonText(nlohmann::ordered_json{{"buses", list}}));
  return ExitCode::kPassed;
}

/// How serving ended, an exception included: whatever it was, the bench is brought down and
/// reported first.
struct Ending {
  ServeReport served;
  std::exception_ptr lost;
};

Ending serveRunner(BenchRunner& runner, const HilArguments& a, std::uint64_t digest) {
  HilParticipant participant(runner);
  LcmTransport transport({a.lcm_url, a.channel}, LinkEnd::kParticipant);
  ServeOptions options;
  options.config_digest = digest;
  options.stop = interruptFlag();
  options.keep_serving = a.keep_serving;
  BusySignal busy;
  options.busy = &busy;
  runner.setSay([&busy](const std::string& doing) { busy.tell(doing); });
  options.say = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
  // In real time the bench goes on by itself; a person must not wait for a controller to hear it.
  options.news = [&runner, said = false]() mutable -> std::string {
    if (said || !runner.hasFault()) return "";
    said = true;
    return "STOPPED: a check has fired and the drives are being brought down; which one is said "
           "when the session ends";
  };
  runner.setStopFlag(options.stop);
  Ending ending;
  try {
    ending.served = serve(participant, transport, options);
  } catch (...) {
    ending.lost = std::current_exception();
  }
  runner.setSay({});
  runner.release();
  return ending;
}

/// The last word of a run: what is still dangerous first, then why it stopped, then how it ended.
ExitCode conclude(const Bench& bench, const Ending& ending) {
  if (!bench.torqueIsOff()) throw TorqueNotOffError("hil: " + bench.lastWord());
  const std::string fault = bench.faultText();
  if (!fault.empty()) {
    throw LostParticipantError("bench", fmt::format("hil: {}. docs/troubleshooting/{}", fault,
                                                    checkOf(bench.safety().fault()).page));
  }
  if (ending.lost) std::rethrow_exception(ending.lost);
  if (ending.served.end == ServeEnd::kInterrupted) return ExitCode::kInterrupted;
  if (ending.served.end == ServeEnd::kAborted) {
    throw LostParticipantError("controller",
                               "hil: the controller ended the session; torque is off");
  }
  return ExitCode::kPassed;
}

CommissionArguments commissionArguments(const HilArguments& a) {
  return {a.config, a.commissioning_record, a.person, a.json};
}

ExitCode commissionOpened(const HilArguments& a) {
  const ConfigNode tree = loadBenchTree(a.config, a.overrides);
  const BenchConfig config = readBenchConfig(tree);
  requireDataSheets(config);
  const OpenBuses buses(config);
  return commissionBench(tree, commissionArguments(a), buses.ends);
}

/// The last word, with the record before it. @throw what conclude() does, OutputError
ExitCode concludeRecorded(const BenchRunner& runner, const Ending& ending, const HilArguments& a,
                          const RunFacts& facts) {
  RunEnd end;
  std::exception_ptr error;
  try {
    end.code = conclude(runner.bench(), ending);
  } catch (const Error& e) {
    error = std::current_exception();
    end = {e.exitCode(), e.what()};
  }
  recordRun(runner, facts, end, a.records);
  if (error) std::rethrow_exception(error);
  return end.code;
}

/// The kernel's floor as this bench's loop would have it.
FloorSettings floorOf(const BenchConfig& config) {
  FloorSettings settings;
  settings.priority = config.realtime.priority;
  settings.period_ns = config.cycle.count();
  return settings;
}

ExitCode serveBench(const HilArguments& a) {
  interruptFlag(SecondSignal::kIsAbsorbed);
  const ConfigNode tree = loadBenchTree(a.config, a.overrides);
  const BenchConfig config = readBenchConfig(tree);
  const std::uint64_t digest = configDigest64(loadBenchScenario(config, a.config));
  requireDataSheets(config);
  RunFacts facts = benchFacts(a.config, a.overrides, tree);
  facts.config_digest = fmt::format("{:016x}", digest);
  requireRoom(config);
  requireFreeAddress({a.lcm_url, a.channel});
  std::optional<KernelFloor::Result> before;
  if (!config.stepped && a.floor_s > 0) {
    fmt::print(stderr, "hil: measures the kernel's floor for {:.3g} s\n", a.floor_s);
    before = measureFloor(floorOf(config), a.floor_s, interruptFlag());
  }
  const OpenBuses buses(config);
  fmt::print(stderr,
             "hil: this program is no emergency stop. Keep the hardware one (STO) within reach.\n");
  const std::string commissioned = requireCommissioned(tree, config, commissionArguments(a),
                                                       a.without_commissioning, buses.ends);
  fmt::print(stderr, "hil: commissioned: {}\n", commissioned);
  const auto report = [&](nlohmann::ordered_json j) {
    j["commissioned"] = commissioned;
    fmt::print("{}", a.json ? jsonText(j) + "\n" : benchText(j));
  };
  if (config.stepped) {
    SteppedRunner runner(config, buses.ends);
    const Ending ending = serveRunner(runner, a, digest);
    report(benchJson(runner.bench(), runner.io()));
    return concludeRecorded(runner, ending, a, facts);
  }
  RealtimeRunner runner(config, buses.ends);
  Ending ending;
  std::unique_ptr<KernelFloor> beside;
  if (a.floor_meanwhile) beside = std::make_unique<KernelFloor>(floorOf(config));
  {
    RecordWriter writer(runner.records(), a.record);
    ending = serveRunner(runner, a, digest);
    runner.finish();
  }
  nlohmann::ordered_json j = benchJson(runner.bench(), runner.io());
  j["realtime"] =
      realtimeJson(runner, before ? &*before : nullptr, beside ? &beside->finish() : nullptr);
  report(j);
  return concludeRecorded(runner, ending, a, facts);
}

// What serving a bench needs.
void addServing(CLI::App& command, HilArguments& a) {
  command.add_option("config", a.config, "Bench file, e.g. configs/hil/bench.yaml");
  command.add_option("--set", a.overrides, "path=value: change one value of the bench file")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command.add_option("--lcm-url", a.lcm_url, "LCM URL; ttl=0 keeps packets on this machine")
      ->capture_default_str();
  command.add_option("--channel", a.channel, "LCM channel")->capture_default_str();
  command.add_flag("--keep-serving", a.keep_serving, "Serve run after run until Ctrl-C");
  command.add_option("--record", a.record, "Write every cycle to this CSV file (real time only)");
  command
      .add_option("--floor-seconds", a.floor_s,
                  "Real time: measure the kernel's own latency so long before the bench; 0: not")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command.add_flag("--floor-meanwhile", a.floor_meanwhile,
                   "Measure it beside the bench, too, in a thread of the same settings");
  addRecordOptions(command, a.records);
  command.add_option("--show-record", a.show_record,
                     "Print the record in this folder: what fired first, what was around it");
}

// What finds out whether a bench is as its file says.
void addInspection(CLI::App& command, HilArguments& a) {
  command.add_flag("--check", a.check,
                   "Ask every node what it is, change nothing, print a table and what disagrees");
  command.add_flag("--commission", a.commission,
                   "Find out, with the robot held and a person's hands, whether the bench is the\n"
                   "one its file describes; then sign a record. With --faults: every case that it\n"
                   "must find, on emulated drives");
  command.add_flag("--rehearse", a.rehearse,
                   "With --commission: show it on emulated drives, by an emulated person");
  command.add_option("--person", a.person, "Who commissions, for the record");
  command.add_option("--commissioning-record", a.commissioning_record,
                     "The record; default: beside the bench file, NAME.commissioned.json");
  command.add_option("--without-commissioning", a.without_commissioning,
                     "Serve real drives without a record, for this reason in words");
}

// What needs no bench.
void addTables(CLI::App& command, HilArguments& a) {
  command.add_flag("--budget", a.budget, "Print how full the buses will be; no bus is opened");
  command.add_flag("--faults", a.faults,
                   "Try every fault on emulated drives in this process and print the table");
  command
      .add_option("--random", a.random,
                  "With --faults: so many random combinations of two or three of them instead")
      ->check(CLI::Range(1, 1'000'000));
  command.add_option("--seed", a.seed, "Of these combinations")->capture_default_str();
  command.add_flag("--checks", a.checks,
                   "Print what the bench checks: name, words, reaction, bound, page");
}

/// Options that say what to do: one of them, but for --commission with --faults or --rehearse.
void requireOneThingToDo(const HilArguments& a) {
  std::vector<std::string> asked;
  const std::pair<const char*, bool> things[] = {
      {"--checks", a.checks},         {"--faults", a.faults && !a.commission},
      {"--commission", a.commission}, {"--show-record", !a.show_record.empty()},
      {"--budget", a.budget},         {"--check", a.check}};
  for (const auto& [name, is] : things) {
    if (is) asked.emplace_back(name);
  }
  if (asked.size() > 1) {
    throw InputError(fmt::format("hil: {} are different things to do; give one of them",
                                 fmt::join(asked, ", ")));
  }
  if (a.random > 0 && !a.faults) throw InputError("hil: --random goes with --faults");
  if (a.rehearse && !a.commission) throw InputError("hil: --rehearse goes with --commission");
  if (a.keep_serving && !asked.empty()) {
    throw InputError(fmt::format("hil: --keep-serving is about serving, not about {}", asked[0]));
  }
}

ExitCode runHil(const HilArguments& a) {
  requireOneThingToDo(a);
  if (a.checks) return showChecks(a.json);
  if (a.commission && a.faults) return showCommissioningCases(a.json);
  if (a.commission && a.rehearse) return rehearseCommission(a.json);
  if (a.faults) {
    return showRows(a.random > 0 ? rehearseRandomFaults(a.random, a.seed) : rehearseFaults(),
                    a.json);
  }
  if (!a.show_record.empty()) {
    showRecord(a.show_record, a.json);
    return ExitCode::kPassed;
  }
  if (a.config.empty()) throw InputError("hil: give a bench file, e.g. configs/hil/bench.yaml");
  if (a.budget) return showBudget(a);
  if (a.check) return showBench(a);
  return a.commission ? commissionOpened(a) : serveBench(a);
}

}  // namespace

void addHilCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "hil", "Serve a bench of real or emulated drives over LCM, in the plant's place");
  const auto a = std::make_shared<HilArguments>();
  addServing(*command, *a);
  addInspection(*command, *a);
  addTables(*command, *a);
  command->add_flag("--json", a->json, "Print results as JSON");
  command->footer(
      "Example, three terminals:\n"
      "  ballbot drives configs/hil/bench.yaml\n"
      "  ballbot hil configs/hil/bench.yaml\n"
      "  ballbot controller configs/scenarios/bench_balance.yaml\n"
      "When a check fires, its last 20 s are written: every frame, every cycle, a page to look "
      "at.\n"
      "  ballbot hil --show-record runs/bench-drive_fault-1.0575s\n"
      "Software is no emergency stop: docs/hil.md.\n"
      "Exit codes: 0 the run ended, 1 a fault did not end as it must (--faults), or\n"
      "commissioning or --check found something wrong, 2 bad input, or a damaged record,\n"
      "3 a check of the bench fired or the controller was lost, 4 a record that was asked for "
      "could\n"
      "not be written, 5 a drive has not said that its torque is off: pull the switch that is "
      "named,\n"
      "130 interrupted.");
  command->callback([&result, a] { result = runHil(*a); });
}

}  // namespace ballbot
