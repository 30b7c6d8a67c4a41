#include <cstdio>
#include <exception>
#include <set>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/nearest_word.hpp"
#include "core/printable_text.hpp"
#include "tools/commands.hpp"
#include "tools/number_options.hpp"
#include "tools/standard_streams.hpp"

namespace ballbot {
namespace {

/// A first word that is no verb is most likely a verb misspelt. @throw InputError
void requireKnownVerb(CLI::App& program, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  if (word.rfind('-', 0) == 0) return;
  std::set<std::string> verbs;
  for (const CLI::App* verb : program.get_subcommands({})) {
    if (verb->get_name() == word) return;
    verbs.insert(verb->get_name());
  }
  const std::string near = nearestWord(word, verbs);
  throw InputError(fmt::format("'{}' is none of its verbs{}. ballbot --help lists them", word,
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

}  // namespace
}  // namespace ballbot

int main(int argc, char** argv) {
  using namespace ballbot;
  prepareStandardStreams();
  CLI::App program{
      "ballbot: co-simulation of a robot that balances on a ball.\n"
      "A high-fidelity plant and a controller, each a process of its own, step each other over "
      "LCM;\n"
      "the same scenario gives the same bytes every time."};
  program.name("ballbot");
  program.set_version_flag("--version", "ballbot " BALLBOT_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Start with:\n"
      "  ballbot run configs/scenarios/balance.yaml\n"
      "Exit codes: 0 passed, 1 a requirement was missed, 2 bad input, 3 a participant was lost, or "
      "a\n"
      "check of the bench fired, 4 output could not be written, 5 a drive of the bench has not "
      "said\n"
      "that its torque is off, 130 interrupted.");

  ExitCode result = ExitCode::kPassed;
  addRunCommand(program, result);
  addCheckCommand(program, result);
  addCompareCommand(program, result);
  addExplainCommand(program, result);
  addExportCommand(program, result);
  addEstimateCommand(program, result);
  addPlantCommand(program, result);
  addControllerCommand(program, result);
  addRelayCommand(program, result);
  addReproduceCommand(program, result);
  addBodeCommand(program, result);
  addViewCommand(program, result);
  addDrivesCommand(program, result);
  addHilCommand(program, result);
  addIdentifyCommand(program, result);
  addFmuCommand(program, result);
  addStudyCommand(program, result);
  addCaptureCommand(program, result);
  addRobotCommand(program, result);
  addDoctorCommand(program, result);

  readNumbersAsFilesDo(program);

  try {
    try {
      requireKnownVerb(program, argc, argv);
      program.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (program.exit(e) != 0) result = ExitCode::kBadInput;
    }
    finishStandardOutput();
  } catch (const Error& e) {
    std::fprintf(stderr, "ballbot: %s\n", printableText(e.what()).c_str());
    return static_cast<int>(e.exitCode());
  } catch (const std::exception& e) {
    // Printing throws where stdout takes no more, beside what nobody foresaw.
    try {
      finishStandardOutput();
      std::fprintf(stderr, "ballbot: unexpected: %s\n", printableText(e.what()).c_str());
    } catch (const OutputError& lost) {
      std::fprintf(stderr, "ballbot: %s\n", printableText(lost.what()).c_str());
    }
    return static_cast<int>(ExitCode::kOutputFailed);
  }
  return static_cast<int>(result);
}
