#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/machine_checks.hpp"

namespace ballbot {
namespace {

const char* word(MachineCheck::Level level) {
  switch (level) {
    case MachineCheck::Level::kOk: return "ok";
    case MachineCheck::Level::kWarning: return "warning";
    case MachineCheck::Level::kBroken: return "broken";
  }
  return "?";
}

ExitCode doctor(bool json) {
  const std::vector<MachineCheck> checks = checkMachine();
  const bool broken = std::any_of(checks.begin(), checks.end(), [](const MachineCheck& c) {
    return c.level == MachineCheck::Level::kBroken;
  });
  if (json) {
    nlohmann::ordered_json out;
    out["healthy"] = !broken;
    for (const MachineCheck& c : checks) {
      out["checks"].push_back({{"name", c.name}, {"level", word(c.level)}, {"found", c.found}, {"mend", c.mend}});
    }
    fmt::print("{}\n", jsonText(out));
  } else {
    for (const MachineCheck& c : checks) {
      fmt::print("{:<17} {:<8} {}\n", c.name, word(c.level), c.found);
      if (!c.mend.empty()) fmt::print("{:<26} to mend it: {}\n", "", c.mend);
    }
  }
  return broken ? ExitCode::kLostParticipant : ExitCode::kPassed;
}

}  // namespace

void addDoctorCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand("doctor", "Look at what runs need of this machine");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print the findings as JSON");
  command->footer("Example:\n  ballbot doctor\nExit codes: 0 nothing is broken, 3 runs over LCM cannot work.");
  command->callback([&result, json] { result = doctor(*json); });
}

}  // namespace ballbot
