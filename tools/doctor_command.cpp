#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/machine_checks.hpp"
#include "tools/realtime_doctor.hpp"

namespace ballbot {
namespace {

const char* word(MachineCheck::Level level) {
  switch (level) {
    case MachineCheck::Level::kOk:
      return "ok";
    case MachineCheck::Level::kWarning:
      return "warning";
    case MachineCheck::Level::kBroken:
      return "broken";
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
      out["checks"].push_back(
          {{"name", c.name}, {"level", word(c.level)}, {"found", c.found}, {"mend", c.mend}});
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
  const auto realtime = std::make_shared<RealtimeDoctorOptions>();
  const auto real_time = std::make_shared<bool>(false);
  command->add_flag(
      "--real-time", *real_time,
      "Look at what makes a bench's loop late instead, and measure what it is worth here");
  command
      ->add_option("--core", realtime->core,
                   "With it: core of the loop (default: the first isolated one, else the last)")
      ->check(CLI::Range(0, 4095));
  command
      ->add_option("--seconds", realtime->seconds, "With it: length of each of four measurements")
      ->check(CLI::Range(0.05, 3600.0))
      ->capture_default_str();
  command->add_flag("--json", realtime->json, "Print the findings as JSON");
  command->footer(
      "Example:\n"
      "  ballbot doctor\n"
      "  ballbot doctor --real-time --core 1 --seconds 10\n"
      "Exit codes: 0 nothing is broken, 1 something makes a real-time loop late (--real-time), 2 "
      "bad\n"
      "input, 3 runs over LCM cannot work.");
  command->callback([&result, realtime, real_time] {
    result = *real_time ? realtimeDoctor(*realtime) : doctor(realtime->json);
  });
}

}  // namespace ballbot
