#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/capture_figure.hpp"
#include "core/number_text.hpp"
#include "experiment/scenario_variants.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "studies/case_check.hpp"
#include "studies/process_pool.hpp"
#include "studies/setting_text.hpp"
#include "tools/capture_output.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"
#include "tools/progress.hpp"
#include "tools/study_output.hpp"

namespace ballbot {
namespace {

// Beyond the bound there is only what the bound leaves out.
constexpr double kBeyondBound = 1.2;
// The drawn bound has so many angles at least, however few directions are searched.
constexpr int kDrawnAngles = 16;

struct CaptureArguments {
  CaptureRequest request;
  BoundRequest bound;
  std::vector<std::string> beside;
  std::string out;
  double blind_ms = 60, up_to_N = 0;
  int jobs = 0;
  bool bound_only = false, resume = false, json = false, quiet = false;

  int processes() const { return jobs > 0 ? jobs : processorCount(); }
};

/// How far each duration and height is searched [N].
std::vector<double> rangesOf(const CaptureArguments& a, const std::vector<CaptureBound>& bounds) {
  const std::size_t places = a.request.durations_s.size() * a.request.heights_m.size();
  std::vector<double> out(places, a.up_to_N);
  if (a.up_to_N > 0) return out;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto& known_N = bounds[i].known_N;
    const double most = *std::max_element(known_N.begin(), known_N.end());
    out[i % places] = std::max(out[i % places], kBeyondBound * most);
  }
  return out;
}

/// The command that goes on with it.
std::vector<std::string> resumeCommand(const CaptureArguments& a, const std::string& folder) {
  const CaptureRequest& r = a.request;
  std::vector<std::string> words = {"ballbot", "capture", r.scenario, "--resume", "--out", folder};
  const auto add = [&](const std::string& option, const std::string& value) {
    words.push_back(option);
    words.push_back(value);
  };
  for (const std::string& text : r.overrides) add("--set", text);
  for (const std::string& text : a.beside) add("--beside", text);
  add("--directions", std::to_string(r.directions));
  for (const double d : r.durations_s) add("--duration-s", numberText(d));
  for (const double h : r.heights_m) add("--height-m", numberText(h));
  add("--start-s", numberText(r.start_s));
  add("--after-s", numberText(r.after_s));
  add("--seeds", std::to_string(r.seeds));
  add("--rate", numberText(r.rate));
  add("--step-N", numberText(r.resolution_N));
  if (a.up_to_N > 0) add("--up-to-N", numberText(a.up_to_N));
  add("--tilt-limit-deg", numberText(a.bound.tilt_limit_deg));
  add("--blind-ms", numberText(a.blind_ms));
  if (a.jobs > 0) add("--jobs", std::to_string(a.jobs));
  return words;
}

void requireDifferent(const std::vector<double>& values, const char* option) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    throw InputError(fmt::format("{}: {:g} is given twice", option,
                                 *std::adjacent_find(sorted.begin(), sorted.end())));
  }
}

/// All variants: the scenario as it is, and those beside it.
void readVariants(CaptureArguments& a) {
  a.request.variants = {{"as given", {}}};
  for (const std::string& text : a.beside) {
    a.request.variants.push_back(CaptureVariant::of(text));
    for (std::size_t i = 0; i + 1 < a.request.variants.size(); ++i) {
      if (a.request.variants[i].label == a.request.variants.back().label)
        throw InputError(fmt::format("--beside {}: is given twice", text));
    }
  }
  requireDifferent(a.request.durations_s, "--duration-s");
  requireDifferent(a.request.heights_m, "--height-m");
}

/// A push on a robot that is held would be survived at any force.
void requireReleased(const CaptureRequest& r, const ConfigNode& scenario_tree) {
  for (const CaptureVariant& v : r.variants) {
    std::vector<std::string> overrides = r.overrides;
    overrides.insert(overrides.end(), v.overrides.begin(), v.overrides.end());
    const double release_s = toSeconds(readScenario(scenario_tree, overrides).release);
    if (release_s < r.start_s) continue;
    throw InputError(
        fmt::format("--start-s {:g}: a stand holds the robot until {:g} s ({}); push it later",
                    r.start_s, release_s, v.label));
  }
}

ExitCode printBounds(const CaptureArguments& a, const CaptureFindings& findings) {
  if (a.json) {
    fmt::print("{}\n", jsonText(captureJson(findings)));
  } else {
    fmt::print("{}", captureText(findings));
  }
  return ExitCode::kPassed;
}

/// The bounds, once everything was read as the runs will read it.
std::vector<CaptureBound> checkedBounds(const CaptureArguments& a,
                                        const ConfigNode& scenario_tree) {
  const Study probe = captureStudy(a.request, std::max(a.up_to_N, a.request.resolution_N));
  checkCases(probe, scenario_tree, CaptureSearch(a.request, probe, rangesOf(a, {})).next());
  requireReleased(a.request, scenario_tree);
  Progress progress("bound", a.quiet);
  return captureBounds(a.request, a.bound, scenario_tree, [&](double share) {
    if (*interruptFlag()) throw InterruptedError("interrupted; nothing was run");
    progress.update(share, "linear programs");
  });
}

/// How far it is, over all rounds.
struct Expected {
  std::size_t before = 0;  ///< runs that ended in earlier rounds
  std::size_t left = 0;    ///< about so many since

  double share(std::size_t done) const {
    const std::size_t all = before + left;
    return all > 0 ? static_cast<double>(before + done) / static_cast<double>(all) : 0;
  }
  std::string note(std::size_t done) const {
    return fmt::format("{} of about {} runs", before + done, before + left);
  }
};

/// Runs what the search asks for until it asks for nothing.
void runUntilKnown(const CaptureArguments& a, const Study& study, const StudyFolder& folder,
                   CaptureSearch& captures, StudyEngine& engine, Expected& expected) {
  try {
    for (auto cases = captures.next(); !cases.empty(); cases = captures.next()) {
      expected = {engine.ranNow(), captures.casesLeft()};
      engine.run(cases);
      captures.take(engine);
    }
  } catch (const Error&) {
    fmt::print(stderr, "\nWhat is done of {} is in {}; go on with\n  {}\n", study.name,
               folder.path(), commandLine(resumeCommand(a, folder.path())));
    throw;
  }
}

void writeFindings(const CaptureArguments& a, const CaptureFindings& findings,
                   const StudyEngine& engine, const StudyFolder& folder) {
  writeTextFile(folder.file("capture.svg"),
                captureFigure(a.request, a.bound, findings.edges, findings.bounds));
  nlohmann::ordered_json summary = captureJson(findings);
  summary["cases"] = engine.cases().size();
  summary["failed"] = failedCases(engine);
  summary["table_digest"] = engine.table().digest();
  writeTextFile(folder.file("capture.json"), jsonText(summary) + "\n");
  if (a.json) {
    summary["study_folder"] = folder.path();
    fmt::print("{}\n", jsonText(summary));
    return;
  }
  fmt::print(
      "{0}  {2:<16} {1}/capture.svg\n  {3:<16} {1}/table.csv, capture.json\n  {4:<16} "
      "{1}/commands.sh\n",
      captureText(findings), folder.path(), "picture", "all runs", "each run alone");
  if (failedCases(engine) > 0) {
    fmt::print("  {} of {} runs crashed, hung or ended in an error: {}/table.csv says which\n",
               failedCases(engine), engine.cases().size(), folder.path());
  }
}

ExitCode runCapture(CaptureArguments& a) {
  const auto started = std::chrono::steady_clock::now();
  readVariants(a);
  a.bound.blind_s = 1e-3 * a.blind_ms;
  if (!a.bound_only) {
    a.bound.per_direction = (kDrawnAngles + a.request.directions - 1) / a.request.directions;
  }
  const ConfigNode scenario_tree = loadScenarioTree(a.request.scenario);
  CaptureFindings findings{a.request, a.bound, checkedBounds(a, scenario_tree), {}};
  if (a.bound_only) return printBounds(a, findings);

  const std::vector<double> ranges = rangesOf(a, findings.bounds);
  const Study study = captureStudy(a.request, *std::max_element(ranges.begin(), ranges.end()));
  const StudyFolder folder = a.resume ? StudyFolder::resume(a.out, study, scenario_tree)
                                      : StudyFolder::create(a.out, study, scenario_tree);
  LocalLauncher::Options options;
  options.results_file = folder.resultsFolder() + "/local.jsonl";
  options.cases_folder = folder.file("cases");
  options.jobs = a.processes();
  options.timeout_s = study.timeout_s;
  options.stop = interruptFlag();
  LocalLauncher launcher(scenario_tree, options);

  CaptureSearch captures(a.request, study, ranges);
  Expected expected;
  Progress progress(study.name, a.quiet);
  StudyEngine engine(study, folder, launcher, [&](std::size_t done, std::size_t) {
    progress.update(expected.share(done), expected.note(done));
  });
  runUntilKnown(a, study, folder, captures, engine, expected);
  progress.finish();
  findings.edges = captures.edges();

  StudyFindings of_study;
  of_study.boundaries = captures.boundaries();
  of_study.jobs = a.processes();
  of_study.wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  writeStudyOutput(study, engine, folder, of_study);
  writeFindings(a, findings, engine, folder);
  return failedCases(engine) == 0 ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

void addOptions(CLI::App& command, CaptureArguments& a) {
  CaptureRequest& r = a.request;
  command.add_option("scenario", r.scenario, "Scenario file; its own pushes are left out")
      ->required();
  const auto repeatable = [](CLI::Option* option) {
    option->expected(1)->allow_extra_args(false)->take_all();
  };
  repeatable(command.add_option("--set", r.overrides,
                                "path=value: change one value of the scenario; repeatable"));
  repeatable(command.add_option("--beside", a.beside,
                                "path=value[; path=value]: look at the scenario with this as well "
                                "and draw it beside; repeatable"));
  command.add_option("--directions", r.directions, "Evenly spaced, from x of the world towards y")
      ->check(CLI::Range(1, 360))
      ->capture_default_str();
  repeatable(
      command.add_option("--duration-s", r.durations_s, "Of the push (default: 0.5); repeatable")
          ->check(CLI::Range(0.001, 100.0)));
  repeatable(command
                 .add_option("--height-m", r.heights_m,
                             "Of the point on the base that is pushed, above the ball's centre "
                             "(default: 0.35); repeatable")
                 ->check(CLI::Range(-10.0, 10.0)));
  command.add_option("--start-s", r.start_s, "When the push sets in; the robot stands by then")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  command.add_option("--after-s", r.after_s, "How long it must not fall from the push's end on")
      ->check(CLI::Range(0.1, 1e4))
      ->capture_default_str();
  command.add_option("--seeds", r.seeds, "Seeds 1 to this many judge each force")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_option("--rate", r.rate, "Share of the seeds that must not fall")
      ->check(CLI::Range(0.01, 0.99))
      ->capture_default_str();
  command.add_option("--step-N", r.resolution_N, "Forces are whole multiples of this")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command
      .add_option("--up-to-N", a.up_to_N, "Largest force looked at (default: 1.2 times the bound)")
      ->check(CLI::Range(0.01, 10000.0));
  command
      .add_option("--blind-ms", a.blind_ms,
                  "For the second bound: so long after its onset nobody knows of a push")
      ->check(CLI::Range(0.0, 10000.0))
      ->capture_default_str();
  command.add_option("--tilt-limit-deg", a.bound.tilt_limit_deg, "Of the base, for the bounds")
      ->check(CLI::Range(1.0, 45.0))
      ->capture_default_str();
  command.add_flag("--bound-only", a.bound_only, "Compute the bounds and run nothing");
  command.add_option("--jobs", a.jobs, "Runs at once (default: one per processor)")
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--timeout-s", r.timeout_s, "Wall-clock time after which a run counts as hung")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  command.add_option("--out", a.out,
                     "Folder to create (default: the next free runs/capture_NAME-NNN)");
  command.add_flag("--resume", a.resume, "Go on in a folder that is there");
  command.add_flag("--json", a.json, "Print as JSON");
  command.add_flag("--quiet", a.quiet, "No progress on stderr");
}

}  // namespace

void addCaptureCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "capture", "Find the largest push that is survived, by direction, and what bounds it");
  const auto a = std::make_shared<CaptureArguments>();
  addOptions(*command, *a);
  command->footer(
      "Examples:\n"
      "  ballbot capture configs/scenarios/push.yaml --bound-only\n"
      "  ballbot capture configs/scenarios/push.yaml --beside controller.kind=lqr --jobs 2\n"
      "  ballbot capture configs/scenarios/push.yaml --directions 2 --duration-s 0.1 --duration-s "
      "0.5\n"
      "docs/capture.md says what came out and what the bounds are.\n"
      "Exit codes: 0 every run ended (survived or not), 1 a run crashed, hung or ended in an "
      "error, "
      "2 bad\n"
      "input, 4 output could not be written, 130 interrupted (go on with --resume).");
  command->callback([&result, a] { result = runCapture(*a); });
}

}  // namespace ballbot
