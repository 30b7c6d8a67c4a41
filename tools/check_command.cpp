#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/number_text.hpp"
#include "cosim/log_compare.hpp"
#include "experiment/checkpoint_files.hpp"
#include "experiment/recorded_run.hpp"
#include "experiment/run_experiment.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"
#include "tools/progress.hpp"

namespace ballbot {
namespace {

struct CheckArguments {
  std::string run;
  std::optional<std::uint64_t> seed;
  bool in_process = false, json = false, quiet = false;
};

/// A folder that goes when this object goes. Not beside the checked run: that may lie where nobody
/// may write.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(failed);
    path_ = (folder / "ballbot_check_XXXXXX").string();
    if (failed || ::mkdtemp(path_.data()) == nullptr) {
      throw OutputError(
          fmt::format("the temporary folder cannot be used: {}. Name another one in TMPDIR",
                      failed ? failed.message() : path_ + ": " + std::strerror(errno)));
    }
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// What is to be found again. @throw InputError if there is nothing complete and undamaged, which
/// is said before anything is run
RecordedSummary recordedSummary(const RunFolder& run) {
  auto summary = readSummary(run);
  if (!summary) {
    throw InputError(fmt::format(
        "{}: was interrupted (there is no summary.json), so there is no whole run to find again. "
        "Run it again and compare what there is: ballbot compare",
        run.path()));
  }
  requireUnedited(run);
  requireWholeLog(run);
  return *summary;
}

ExitCode checkRun(const CheckArguments& arguments) {
  const RunFolder original = RunFolder::open(arguments.run);
  const RecordedSummary then = recordedSummary(original);
  const std::string other_build = buildDifference(readManifest(original));
  const Scenario scenario = loadScenario(original.scenarioFile(), {}, arguments.seed);
  const ScratchFolder scratch;

  Progress progress("check " + scenario.name, arguments.quiet);
  RunOptions options;
  options.in_process = arguments.in_process;
  options.write_report = false;
  options.start = readStart(original);
  options.stop = interruptFlag();
  options.progress = [&](SimTime now) {
    if (toNs(now) % 10'000'000 == 0)
      progress.update(toSeconds(now) / toSeconds(scenario.duration), "");
  };
  const RunFolder again = runExperiment(scenario, scratch.path(), options).folder;
  progress.finish();

  auto difference = compareLogs(original.logFile(), again.logFile());
  const bool identical = !difference && then.text == readTextFile(again.summaryFile());
  std::string text = difference  ? difference->text
                     : identical ? "identical"
                                 : "summary.json differs, the log does not";
  if (!other_build.empty()) text += "\nThis is another build: " + other_build;
  if (arguments.json) {
    nlohmann::ordered_json out;
    out["identical"] = identical;
    out["text"] = text;
    if (difference) {
      out["tick"] = difference->tick;
      out["time_s"] = decimalSeconds(toNs(difference->time));
      if (difference->channel) out["channel"] = channelName(*difference->channel);
    }
    fmt::print("{}\n", jsonText(out));
  } else {
    fmt::print("{}\n", text);
    if (!identical) fmt::print("See docs/troubleshooting/digest-differs.md\n");
  }
  return identical ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

}  // namespace

void addCheckCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command =
      program.add_subcommand("check", "Run a run folder again and say whether it is identical");
  const auto a = std::make_shared<CheckArguments>();
  command->add_option("run", a->run, "Run folder")->required();
  command->add_option("--seed", a->seed,
                      "Run again with another seed, to see where noise first shows");
  command->add_flag("--in-process", a->in_process,
                    "Run again in one process; the bits must be the same");
  command->add_flag("--json", a->json, "Print as JSON");
  command->add_flag("--quiet", a->quiet, "No progress on stderr");
  command->footer(
      "Example:\n  ballbot check runs/balance-001\n"
      "Exit codes: 0 identical, 1 it differs (the first tick and channel are named), 2 bad input,\n"
      "or the folder is damaged, was edited, or is of an interrupted run, 3 a participant was "
      "lost.");
  command->callback([&result, a] { result = checkRun(*a); });
}

}  // namespace ballbot
