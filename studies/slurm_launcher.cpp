#include "studies/slurm_launcher.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "experiment/scenario_variants.hpp"
#include "experiment/text_file.hpp"
#include "studies/result_log.hpp"
#include "studies/setting_text.hpp"
#include "studies/shell_command.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTasks = 500;  // Slurm's default limit of an array is 1000
constexpr std::size_t kLeastCasesPerTask = 4;
constexpr int kQueuePeriod_ms = 1000;

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

std::string chunkText(const std::vector<StudyCase>& cases, std::size_t begin, std::size_t end) {
  std::string out;
  for (std::size_t i = begin; i < end; ++i) {
    out +=
        nlohmann::ordered_json{
            {"case", cases[i].id}, {"seed", cases[i].seed}, {"overrides", cases[i].overrides}}
            .dump() +
        "\n";
  }
  return out;
}

std::vector<StudyCase> readChunk(const std::string& path) {
  std::vector<StudyCase> cases;
  const std::string text = readTextFile(path);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    try {
      const auto j = nlohmann::json::parse(text.substr(begin, end - begin));
      StudyCase c;
      c.id = j.at("case");
      c.seed = j.at("seed");
      c.overrides = j.at("overrides").get<std::vector<std::string>>();
      cases.push_back(std::move(c));
    } catch (const nlohmann::json::exception& e) {
      throw InputError(fmt::format("{}: not a list of cases: {}", path, e.what()));
    }
    begin = end + 1;
  }
  return cases;
}

/// Slurm's answer to a question that it may be too busy for, or a tool that is not there.
[[noreturn]] void refuse(const std::string& tool, const CommandEnd& end) {
  if (end.exit_code == 127) {
    throw InputError(
        tool +
        ": not found. --launcher slurm needs Slurm's commands on this machine (Debian: slurm-wlm)");
  }
  throw InputError(
      fmt::format("{} ended with exit code {}: {}", tool, end.exit_code, trimmed(end.err)));
}

}  // namespace

std::string SlurmLauncher::submit(const std::vector<StudyCase>& cases) {
  const fs::path folder = fs::absolute(folder_.path());
  fs::path round;
  for (int i = 1; round.empty() || fs::exists(round); ++i)
    round = folder / "slurm" / fmt::format("{:03}", i);
  fs::create_directories(round);
  const std::size_t per_task =
      options_.cases_per_task > 0
          ? static_cast<std::size_t>(options_.cases_per_task)
          : std::max(kLeastCasesPerTask, (cases.size() + kMostTasks - 1) / kMostTasks);
  const std::size_t tasks = (cases.size() + per_task - 1) / per_task;
  for (std::size_t t = 0; t < tasks; ++t) {
    writeTextFile((round / fmt::format("chunk-{}.jsonl", t)).string(),
                  chunkText(cases, t * per_task, std::min(cases.size(), (t + 1) * per_task)));
  }
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  const std::string script = (round / "job.sh").string();
  writeTextFile(script, fmt::format("#!/bin/sh\n# One task of a study: the cases of "
                                    "chunk-N.jsonl.\nexec {} \"$SLURM_ARRAY_TASK_ID\"\n",
                                    commandLine({program, "study-task", folder.string(),
                                                 round.filename().string(), "--timeout-s",
                                                 numberText(options_.timeout_s), "--task"})));
  std::vector<std::string> words = {"sbatch",
                                    "--parsable",
                                    fmt::format("--array=0-{}", tasks - 1),
                                    "--job-name=" + options_.name,
                                    "--output=" + (round / "%a.out").string(),
                                    "--open-mode=append",
                                    "--requeue",
                                    "--ntasks=1",
                                    "--cpus-per-task=1"};
  words.insert(words.end(), options_.sbatch_options.begin(), options_.sbatch_options.end());
  words.push_back(script);
  const CommandEnd end = runCommand(words);
  if (end.exit_code != 0) refuse("sbatch", end);
  const std::string job = trimmed(end.out.substr(0, end.out.find(';')));
  if (options_.say) {
    options_.say(fmt::format(
        "submitted job {}: {} cases in {} tasks of up to {}; see squeue -j {}, output in {}", job,
        cases.size(), tasks, per_task, job, round.string()));
  }
  return job;
}

void SlurmLauncher::waitFor(const std::string& job, const std::function<void()>& collect) {
  while (true) {
    if (options_.stop && *options_.stop) {
      runCommand({"scancel", job});
      throw InterruptedError("interrupted; job " + job + " was cancelled");
    }
    const CommandEnd queue = runCommand({"squeue", "--noheader", "--jobs", job, "--format=%T"});
    collect();
    // squeue answers "Invalid job id" once the controller has forgotten a finished job. Any other
    // trouble is the controller's (busy, restarting): ask again.
    const bool forgotten = queue.err.find("Invalid job id") != std::string::npos;
    if (forgotten || (queue.exit_code == 0 && trimmed(queue.out).empty())) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(kQueuePeriod_ms));
  }
}

void SlurmLauncher::launch(const std::vector<StudyCase>& cases,
                           const std::function<void(const CaseResult&)>& ended) {
  std::set<std::string> wanted;
  for (const StudyCase& c : cases) wanted.insert(c.id);
  const auto collect = [&] {
    for (const auto& [id, result] : folder_.results()) {
      if (wanted.erase(id) > 0) ended(result);
    }
  };
  std::string job;
  for (int i = 0; i < options_.submissions; ++i) {
    std::vector<StudyCase> missing;
    std::copy_if(cases.begin(), cases.end(), std::back_inserter(missing),
                 [&](const StudyCase& c) { return wanted.count(c.id) > 0; });
    if (missing.empty()) return;
    job = submit(missing);
    if (options_.submit_only) throw InterruptedError("job " + job + " was submitted");
    waitFor(job, collect);
    collect();
  }
  if (!wanted.empty()) {
    throw LostParticipantError(
        "slurm",
        fmt::format(
            "{} cases have no result after {} submissions; the last was job {}, "
            "its output is below {}/slurm. Nothing that is done is lost: go on with --resume",
            wanted.size(), options_.submissions, job, folder_.path()));
  }
}

void runChunk(const std::string& scenario_file, const std::string& chunk_file,
              const std::string& results_file, const std::string& cases_folder, double timeout_s,
              const std::atomic<bool>* stop) {
  std::vector<StudyCase> cases = readChunk(chunk_file);
  std::set<std::string> done;  // by this task before Slurm put it back into the queue
  if (fs::exists(results_file)) {
    for (const std::string& record : readResultLog(results_file).records)
      done.insert(CaseResult::fromJson(record).id);
  }
  cases.erase(std::remove_if(cases.begin(), cases.end(),
                             [&](const StudyCase& c) { return done.count(c.id) > 0; }),
              cases.end());
  LocalLauncher::Options options;
  options.results_file = results_file;
  options.cases_folder = cases_folder;
  options.timeout_s = timeout_s;
  options.stop = stop;
  LocalLauncher(loadScenarioTree(scenario_file), options).launch(cases, [](const CaseResult&) {});
}

}  // namespace ballbot
