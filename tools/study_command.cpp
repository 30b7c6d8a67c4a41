#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/number_text.hpp"
#include "core/yaml_file.hpp"
#include "experiment/scenario_variants.hpp"
#include "report/json_text.hpp"
#include "studies/case_check.hpp"
#include "studies/process_pool.hpp"
#include "studies/setting_text.hpp"
#include "studies/slurm_launcher.hpp"
#include "studies/study_search.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"
#include "tools/progress.hpp"
#include "tools/study_output.hpp"

namespace ballbot {
namespace {

struct StudyArguments {
  std::string study, out, launcher = "local", find;
  std::vector<std::string> overrides, sbatch_options;
  std::vector<double> between;
  double rate = 0.5;
  int jobs = 0, cases_per_task = 0;
  bool whole = false, resume = false, retry = false, keep_runs = false, submit_only = false,
       json = false, quiet = false;
};

/// --set: for all cases, and part of what the study is.
void addOverride(Study& study, const std::string& text) {
  const auto [path, value] = readOverride(text);
  study.base.emplace_back(path, value);
  if (!study.tree.find("set")) study.tree.set("set", ConfigNode::map({}));
  study.tree.find("set")->set(path, value);
}

/// --find boundary=AXIS or boundary=PATH, instead of the study's own search.
void addSearch(Study& study, const StudyArguments& a) {
  const std::string prefix = "boundary=";
  if (a.find.rfind(prefix, 0) != 0) {
    throw InputError("--find " + a.find +
                     ": write --find boundary=AXIS or --find boundary=CONFIGURATION.PATH");
  }
  const std::string what = a.find.substr(prefix.size());
  auto axis = std::find_if(study.axes.begin(), study.axes.end(),
                           [&](const StudyAxis& x) { return x.name == what; });
  if (axis == study.axes.end()) {
    if (a.between.size() != 2)
      throw InputError("--find " + a.find + ": say where to look, e.g. --between 5 80");
    study.axes.push_back({what, "", {{what, 1, 1}}, {}, {}});
    axis = std::prev(study.axes.end());
  }
  if (axis->paths.empty())
    throw InputError("--find " + a.find + ": this axis has no numbers to search among");
  if (a.between.size() == 2) {
    if (!(a.between[0] < a.between[1]))
      throw InputError("--between: the second number must be larger");
    axis->range = AxisRange{a.between[0], a.between[1], a.between[0] > 0, a.whole};
  } else if (!axis->range) {
    std::vector<double> numbers;
    for (const AxisOption& option : axis->options) numbers.push_back(option.number.value_or(0));
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    axis->range = AxisRange{*low, *high, *low > 0, a.whole};
  }
  axis->options.clear();
  SearchDefinition search;
  search.axis = what;
  search.rate = a.rate;
  study.search = search;
  ConfigNode note = ConfigNode::map({});
  note.set("axis", ConfigNode::scalar(what, false, {}));
  note.set("low", ConfigNode::scalar(numberText(axis->range->low), false, {}));
  note.set("high", ConfigNode::scalar(numberText(axis->range->high), false, {}));
  if (axis->range->whole) note.set("whole", ConfigNode::scalar("true", false, {}));
  note.set("rate", ConfigNode::scalar(numberText(a.rate), false, {}));
  study.tree.set("search", note);
}

std::unique_ptr<CaseLauncher> makeLauncher(const StudyArguments& a, const Study& study,
                                           const StudyFolder& folder,
                                           const ConfigNode& scenario_tree) {
  if (a.launcher == "slurm") {
    SlurmLauncher::Options options;
    options.name = study.name;
    options.cases_per_task = a.cases_per_task;
    options.timeout_s = study.timeout_s;
    options.sbatch_options = a.sbatch_options;
    options.submit_only = a.submit_only;
    options.stop = interruptFlag();
    options.say = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
    return std::make_unique<SlurmLauncher>(folder, options);
  }
  LocalLauncher::Options options;
  options.results_file = folder.resultsFolder() + "/local.jsonl";
  options.cases_folder = folder.file("cases");
  options.jobs = a.jobs > 0 ? a.jobs : processorCount();
  options.timeout_s = study.timeout_s;
  options.keep_runs = a.keep_runs;
  options.stop = interruptFlag();
  return std::make_unique<LocalLauncher>(scenario_tree, options);
}

/// What tasks on other machines left when they were killed.
void removeScratch(const StudyFolder& folder) {
  std::error_code ignored;
  std::filesystem::remove_all(folder.file("scratch"), ignored);
}

/// The command that goes on with a study. All that decides what the study is must stand in it.
std::vector<std::string> resumeCommand(const StudyArguments& a, const StudyFolder& folder) {
  std::vector<std::string> words = {"ballbot",  "study", a.study,
                                    "--resume", "--out", folder.path()};
  const auto add = [&](std::initializer_list<std::string> more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  for (const std::string& text : a.overrides) add({"--set", text});
  if (!a.find.empty()) {
    add({"--find", a.find, "--rate", numberText(a.rate)});
    if (a.between.size() == 2) {
      add({"--between", numberText(a.between[0]), numberText(a.between[1])});
    }
    if (a.whole) add({"--whole"});
  }
  if (a.keep_runs) add({"--keep-runs"});
  if (a.jobs > 0) add({"--jobs", std::to_string(a.jobs)});
  if (a.launcher == "local") return words;
  add({"--launcher", a.launcher});
  if (a.cases_per_task > 0) add({"--cases-per-task", std::to_string(a.cases_per_task)});
  for (const std::string& option : a.sbatch_options) add({"--sbatch=" + option});
  return words;
}

ExitCode runStudy(const StudyArguments& a) {
  const auto started = std::chrono::steady_clock::now();
  Study study = loadStudy(a.study);
  for (const std::string& text : a.overrides) addOverride(study, text);
  if (!a.find.empty()) addSearch(study, a);
  const ConfigNode scenario_tree = loadScenarioTree(study.scenario);
  const std::vector<StudyCase> cases =
      study.search ? searchProbeCases(study) : generateCases(study);
  checkCases(study, scenario_tree, cases);

  const StudyFolder folder = a.resume ? StudyFolder::resume(a.out, study, scenario_tree)
                                      : StudyFolder::create(a.out, study, scenario_tree);
  if (a.retry) folder.dropFailures();
  const auto launcher = makeLauncher(a, study, folder, scenario_tree);

  Progress progress(study.name, a.quiet);
  StudyEngine engine(study, folder, *launcher, [&](std::size_t done, std::size_t count) {
    const double fraction = count > 0 ? static_cast<double>(done) / static_cast<double>(count) : 1;
    progress.update(fraction, fmt::format("{} of {} cases", done, count));
  });
  StudyFindings findings;
  try {
    if (study.search) {
      findings.boundaries = runSearch(study, engine);
    } else {
      engine.run(cases);
    }
  } catch (const Error&) {
    progress.finish();
    fmt::print(stderr, "What is done is in {}; go on with\n  {}\n", folder.path(),
               commandLine(resumeCommand(a, folder)));
    if (a.submit_only && !*interruptFlag()) return ExitCode::kPassed;
    throw;
  }
  progress.finish();
  removeScratch(folder);
  findings.wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  findings.jobs = a.launcher == "local" ? (a.jobs > 0 ? a.jobs : processorCount()) : 0;
  writeStudyOutput(study, engine, folder, findings);
  if (a.json) {
    fmt::print("{}\n", jsonText(studySummary(study, engine, folder, findings)));
  } else {
    fmt::print("{}", studyText(study, engine, folder, findings));
  }
  return failedCases(engine) == 0 ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

struct TaskArguments {
  std::string folder, round, task;
  double timeout_s = 600;
};

ExitCode runTask(const TaskArguments& a) {
  const std::string chunk = a.folder + "/slurm/" + a.round + "/chunk-" + a.task + ".jsonl";
  const std::string results =
      fmt::format("{}/results/slurm-{}-{}.jsonl", a.folder, a.round, a.task);
  // Of this attempt alone: when a node is lost, what ran there may still run beside its successor.
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  const std::string cases =
      fmt::format("{}/scratch/{}-{}-{}-{}", a.folder, a.round, a.task, host, ::getpid());
  runChunk(a.folder + "/scenario.yaml", chunk, results, cases, a.timeout_s, interruptFlag());
  return ExitCode::kPassed;
}

}  // namespace

void addStudyCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command =
      program.add_subcommand("study", "Run a scenario many times with varied configuration");
  const auto a = std::make_shared<StudyArguments>();
  command->add_option("study", a->study, "Study file")->required();
  command->add_option("--jobs", a->jobs, "Cases at once (default: one per processor)")
      ->check(CLI::Range(1, 4096));
  command->add_option("--out", a->out, "Folder to create (default: the next free runs/NAME-NNN)");
  command->add_flag("--resume", a->resume,
                    "Go on in a folder that is there (default: the newest of this study)");
  command->add_flag("--retry", a->retry, "With --resume: run crashed, hung and failed cases again")
      ->needs("--resume");
  command
      ->add_option("--set", a->overrides, "path=value: change one value in all cases; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--find", a->find,
                      "boundary=AXIS or boundary=PATH: bisect to where cases stop to pass");
  command->add_option("--between", a->between, "Range of values for --find")->expected(2);
  command->add_flag("--whole", a->whole, "Only whole numbers for --find, e.g. ticks");
  command->add_option("--rate", a->rate, "Share of seeds that must pass for --find")
      ->check(CLI::Range(0.01, 0.99))
      ->capture_default_str();
  command->add_flag("--keep-runs", a->keep_runs,
                    "Keep each case's run folder, with log and report");
  command->add_option("--launcher", a->launcher, "Where cases run")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  command
      ->add_option("--cases-per-task", a->cases_per_task,
                   "Slurm: cases in one task of the job array")
      ->check(CLI::Range(1, 1000000));
  command
      ->add_option("--sbatch", a->sbatch_options,
                   "Slurm: option handed to sbatch, e.g. --sbatch=--partition=short; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_flag("--submit-only", a->submit_only,
                    "Slurm: do not wait; collect later with --resume");
  command->add_flag("--json", a->json, "Print the summary as JSON");
  command->add_flag("--quiet", a->quiet, "No progress on stderr");
  command->footer(
      "Examples:\n"
      "  ballbot study configs/studies/smoke.yaml --jobs 2\n"
      "  ballbot study configs/studies/smoke.yaml --resume\n"
      "  ballbot study configs/studies/smoke.yaml --find boundary=plant.transport_delay_ticks \\\n"
      "      --between 2 100 --whole\n"
      "  ballbot study configs/studies/sea_bandwidth.yaml --launcher slurm "
      "--sbatch=--partition=short\n"
      "Exit codes: 0 every case ran (passed or not), 1 a case crashed, hung or ended in an error, "
      "2 bad\n"
      "input, 3 cases were lost, 4 output could not be written, 130 interrupted (go on with "
      "--resume).");
  command->callback([&result, a] { result = runStudy(*a); });

  CLI::App* task = program.add_subcommand("study-task", "One task of a study's job array");
  task->group("");  // for job scripts, not for people
  const auto t = std::make_shared<TaskArguments>();
  task->add_option("folder", t->folder)->required();
  task->add_option("round", t->round)->required();
  task->add_option("--task", t->task)->required();
  task->add_option("--timeout-s", t->timeout_s);
  task->callback([&result, t] { result = runTask(*t); });
}

}  // namespace ballbot
