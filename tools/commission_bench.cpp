#include "tools/commission_bench.hpp"

#include <algorithm>
#include <iostream>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>

#include "hil/bench_check.hpp"
#include "hil/commissioning/commissioning.hpp"
#include "hil/realtime_runner.hpp"
#include "hil/rehearsal/commissioning_trial.hpp"
#include "hil/stepped_runner.hpp"
#include "report/json_text.hpp"
#include "tools/bench_report.hpp"
#include "tools/commissioning_record.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

constexpr int kLookAtFlagMs = 100;
constexpr std::size_t kLeastReason = 10;  // letters of a reason in words

/// A line, waited for so that Ctrl-C ends the wait. @throw InterruptedError
std::string answerOf(std::istream& in) {
  pollfd ready{STDIN_FILENO, POLLIN, 0};
  while (in.rdbuf()->in_avail() == 0 && ::poll(&ready, 1, kLookAtFlagMs) == 0) {
    if (interruptFlag()->load()) throw InterruptedError("hil: stopped; no drive has had torque");
  }
  if (interruptFlag()->load()) throw InterruptedError("hil: stopped; no drive has had torque");
  std::string line;
  std::getline(in, line);
  return line;
}

/// Says what to do on stderr, and asks before torque comes.
class PersonAtTerminal final : public CommissioningPerson {
 public:
  void begin(const CommissioningTask& task) override { fmt::print(stderr, "\n>> {}\n", task.text); }
  void hear(const CommissioningTask& task, const std::string& words) override {
    fmt::print(stderr, "   {}: {}\n", task.name, words);
  }
  bool allowsTorque() override {
    fmt::print(stderr,
               "\n>> Now one drive after the other gets low torque. Robot upright and held, wheels "
               "off the ball,\n   arm on its rest, nobody within reach, emergency stop at hand. "
               "Type yes: ");
    return answerOf(std::cin) == "yes";
  }
};

std::vector<NodeReport> requireNodes(const BenchConfig& config, const std::vector<CanBus*>& buses) {
  std::vector<NodeReport> nodes = checkBench(config, buses);
  if (allGood(nodes)) return nodes;
  throw InputError("hil: not every node is there and as configured\n" + checkTable(nodes, {}));
}

ExitCode conclude(const CommissioningReport& report, bool json) {
  const auto wrong = std::count_if(report.rows.begin(), report.rows.end(),
                                   [](const CommissioningRow& row) { return !row.good; });
  if (json) {
    nlohmann::ordered_json j{{"passed", report.passed}, {"torque_was_on", report.torque_was_on}};
    j["tasks"] = nlohmann::ordered_json::array();
    for (const CommissioningRow& row : report.rows) {
      j["tasks"].push_back({{"name", row.name}, {"good", row.good}, {"words", row.words}});
    }
    fmt::print("{}\n", jsonText(j));
  } else {
    for (const CommissioningRow& row : report.rows) {
      fmt::print("{:<6} {:<20} {}\n", row.good ? "good" : "WRONG", row.name, row.words);
    }
    fmt::print("{}\n", report.passed
                           ? "commissioned: the bench is the one its file describes"
                           : fmt::format("not commissioned: {} of {} tasks were wrong{}", wrong,
                                         report.rows.size(),
                                         report.torque_was_on ? "" : "; no drive has had torque"));
  }
  return report.passed ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

std::string recordPath(const CommissionArguments& a) {
  return a.record_path.empty() ? commissioningPath(a.bench_path) : a.record_path;
}

/// Brings the bench down whatever happened, and says so.
CommissioningReport commissionOn(BenchRunner& runner) {
  runner.setStopFlag(interruptFlag(SecondSignal::kIsAbsorbed));
  PersonAtTerminal person;
  try {
    CommissioningReport report = commission(runner, person);
    runner.release();
    if (!runner.bench().torqueIsOff()) runner.requireGoodEnd();
    return report;
  } catch (...) {
    runner.release();
    throw;
  }
}

}  // namespace

ExitCode commissionBench(const ConfigNode& tree, const CommissionArguments& a,
                         const std::vector<CanBus*>& buses) {
  if (a.person.empty()) {
    throw InputError("hil: --commission needs --person NAME: who has done it signs the record");
  }
  const BenchConfig config = readBenchConfig(tree);
  const std::vector<NodeReport> nodes = requireNodes(config, buses);
  CommissioningReport report;
  if (config.stepped) {
    SteppedRunner runner(config, buses);
    report = commissionOn(runner);
  } else {
    RealtimeRunner runner(config, buses);
    report = commissionOn(runner);
  }
  const ExitCode code = conclude(report, a.json);
  if (!report.passed) return code;
  writeCommissioningRecord(recordPath(a), recordOf(tree, nodes, a.person), report);
  fmt::print(stderr, "hil: wrote {}, signed by {}\n", recordPath(a), a.person);
  return code;
}

ExitCode rehearseCommission(bool json) {
  PersonAtTerminal narrator;
  return conclude(
      rehearseCommissioning(commissioningCases().front(), RunnerKind::kStepped, &narrator), json);
}

ExitCode showCommissioningCases(bool json) {
  bool held = true;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CommissioningCase& c : commissioningCases()) {
    const CommissioningReport report = rehearseCommissioning(c, RunnerKind::kStepped);
    const std::string found = foundBy(report);
    const bool good = found == c.found_by && report.passed == c.found_by.empty();
    held = held && good;
    std::string words;
    for (const CommissioningRow& row : report.rows) {
      if (words.empty() && !row.good) words = row.words;
    }
    list.push_back({{"name", c.name},
                    {"expected", c.found_by},
                    {"found_by", found},
                    {"torque_was_on", report.torque_was_on},
                    {"words", words},
                    {"held", good}});
    if (json) continue;
    fmt::print("{:<4} {:<48} {:<18} {}\n", good ? "ok" : "MISS", c.name,
               found.empty() ? "passes" : found, words);
  }
  if (json) fmt::print("{}\n", jsonText(nlohmann::ordered_json{{"rows", list}, {"held", held}}));
  return held ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

std::string requireCommissioned(const ConfigNode& tree, const BenchConfig& config,
                                const CommissionArguments& a, const std::string& without,
                                const std::vector<CanBus*>& buses) {
  if (config.stepped) return "emulated drives";  // set-up refuses others
  if (!without.empty()) {
    if (without.size() >= kLeastReason) return "without, because: " + without;
    throw InputError(
        "hil: --without-commissioning needs a reason in words: it goes into the report");
  }
  const std::vector<NodeReport> nodes = requireNodes(config, buses);
  if (std::all_of(nodes.begin(), nodes.end(), isEmulated)) return "emulated drives";
  CommissioningRecord then;
  try {
    then = readCommissioningRecord(recordPath(a));
  } catch (const InputError& e) {
    throw InputError(fmt::format(
        "hil: real drives, and no record that this bench was commissioned: {}. First: ballbot hil "
        "{} --commission --person NAME; or --without-commissioning \"why\"",
        e.what(), a.bench_path));
  }
  const auto changes = changesSince(then, recordOf(tree, nodes, then.by));
  if (changes.empty()) return fmt::format("by {}, {}", then.by, then.at);
  std::string text = fmt::format("hil: {} has changed since {} commissioned it ({}):\n",
                                 a.bench_path, then.by, then.at);
  for (const std::string& change : changes) text += "  " + change + "\n";
  throw InputError(text + "Commission it anew: --commission --person NAME");
}

}  // namespace ballbot
