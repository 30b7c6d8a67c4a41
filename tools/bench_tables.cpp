#include "tools/bench_tables.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hil/bench_fault.hpp"
#include "report/json_text.hpp"

namespace ballbot {

ExitCode showRows(const std::vector<FaultRow>& rows, bool json) {
  bool held = true;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  if (!json) {
    fmt::print("{:<4} {:<62} {:<10} {:<26} {:>5} {:>6} {:>4}  {}\n", "", "fault", "runner",
               "expected", "bound", "cycles", "exit", "what the bench said");
  }
  for (const FaultRow& r : rows) {
    held = held && r.held;
    list.push_back({{"name", r.fault},
                    {"runner", toText(r.runner)},
                    {"expected", r.expected},
                    {"bound_cycles", r.bound_cycles},
                    {"measured_cycles", r.measured_cycles},
                    {"check", r.check},
                    {"reason", r.reason},
                    {"exit_code", r.exit_code},
                    {"says_off", r.says_off},
                    {"torque_on", r.torque_on},
                    {"held", r.held}});
    if (json) continue;
    fmt::print("{:<4} {:<62} {:<10} {:<26} {:>5} {:>6} {:>4}  {}\n", r.held ? "ok" : "MISS",
               r.fault, toText(r.runner), r.expected, r.bound_cycles, r.measured_cycles,
               r.exit_code, r.reason);
  }
  if (json) fmt::print("{}\n", jsonText(nlohmann::ordered_json{{"rows", list}, {"held", held}}));
  return held ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

ExitCode showChecks(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Check& c : checkTable()) {
    if (c.fault == BenchFault::kNone) continue;
    const bool damps = c.reaction == FirstReaction::kDamp;
    list.push_back({{"name", c.name},
                    {"words", c.words},
                    {"reaction", damps ? "damping, then torque off" : "torque off"},
                    {"bound_cycles", c.bound_cycles},
                    {"page", c.page}});
    if (json) continue;
    fmt::print("{:<20} {:<76} {:<25} {:>4}  {}\n", c.name, c.words,
               damps ? "damping, then torque off" : "torque off", c.bound_cycles, c.page);
  }
  if (json) fmt::print("{}\n", jsonText(nlohmann::ordered_json{{"checks", list}}));
  return ExitCode::kPassed;
}

}  // namespace ballbot
