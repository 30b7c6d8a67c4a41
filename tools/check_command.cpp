#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "cosim/log_compare.hpp"
#include "experiment/build_info.hpp"
#include "experiment/checkpoint_files.hpp"
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

/// A folder beside the checked run that goes when this object goes.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& beside)
      : path_(fmt::format("{}.check-{}", std::filesystem::path(beside).lexically_normal().string(), ::getpid())) {}
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Names what in the manifest is not as when the run was made: bits are promised for one build.
std::string buildDifference(const RunFolder& run) {
  const auto manifest = nlohmann::json::parse(readTextFile(run.manifestFile()), nullptr, false);
  if (manifest.is_discarded() || !manifest.contains("build")) {
    throw InputError(run.manifestFile() + ": is not a manifest; was the folder edited?");
  }
  std::string out;
  for (const auto& [key, now] : buildInfo()) {
    const std::string then = manifest["build"].value(key, "");
    if (then != now) out += fmt::format("{}{} was {}, is {}", out.empty() ? "" : "; ", key, then, now);
  }
  return out;
}

ExitCode checkRun(const CheckArguments& arguments) {
  const RunFolder original = RunFolder::open(arguments.run);
  const std::string other_build = buildDifference(original);
  const Scenario scenario = loadScenario(original.scenarioFile(), {}, arguments.seed);
  const ScratchFolder scratch(original.path());

  Progress progress("check " + scenario.name, arguments.quiet);
  RunOptions options;
  options.in_process = arguments.in_process;
  options.write_report = false;
  options.start = readStart(original);
  options.stop = interruptFlag();
  options.progress = [&](SimTime now) {
    if (toNs(now) % 10'000'000 == 0) progress.update(toSeconds(now) / toSeconds(scenario.duration), "");
  };
  const RunFolder again = runExperiment(scenario, scratch.path(), options).folder;
  progress.finish();

  auto difference = compareLogs(original.logFile(), again.logFile());
  const std::string summary_then = readTextFile(original.summaryFile());
  const std::string summary_now = readTextFile(again.summaryFile());
  const bool identical = !difference && summary_then == summary_now;
  std::string text = difference ? difference->text : identical ? "identical" : "summary.json differs, the log does not";
  if (!identical && !other_build.empty()) text += "\nThis is another build: " + other_build;
  if (arguments.json) {
    nlohmann::ordered_json out;
    out["identical"] = identical;
    out["text"] = text;
    if (difference) {
      out["tick"] = difference->tick;
      out["time_s"] = toSeconds(difference->time);
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
  CLI::App* command = program.add_subcommand("check", "Run a run folder again and say whether it is identical");
  const auto a = std::make_shared<CheckArguments>();
  command->add_option("run", a->run, "Run folder")->required();
  command->add_option("--seed", a->seed, "Run again with another seed, to see where noise first shows");
  command->add_flag("--in-process", a->in_process, "Run again in one process; the bits must be the same");
  command->add_flag("--json", a->json, "Print as JSON");
  command->add_flag("--quiet", a->quiet, "No progress on stderr");
  command->footer(
      "Example:\n  ballbot check runs/balance-001\n"
      "Exit codes: 0 identical, 1 it differs (the first tick and channel are named), 2 bad input,\n"
      "3 a participant was lost.");
  command->callback([&result, a] { result = checkRun(*a); });
}

}  // namespace ballbot
