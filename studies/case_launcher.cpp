#include "studies/case_launcher.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "studies/case_run.hpp"
#include "studies/process_pool.hpp"
#include "studies/result_log.hpp"

namespace ballbot {

namespace fs = std::filesystem;

void LocalLauncher::launch(const std::vector<StudyCase>& cases,
                           const std::function<void(const CaseResult&)>& ended) {
  ResultLog log(options_.results_file);
  std::error_code failed;
  fs::create_directories(options_.cases_folder, failed);
  if (failed)
    throw OutputError(
        fmt::format("{}: cannot be created: {}", options_.cases_folder, failed.message()));
  const auto folderOf = [&](std::size_t i) { return options_.cases_folder + "/" + cases[i].id; };

  PoolOptions pool;
  pool.jobs = options_.jobs;
  pool.timeout = std::chrono::milliseconds(static_cast<long>(1000 * options_.timeout_s));
  pool.stop = options_.stop;
  runInProcesses(
      cases.size(),
      [&](std::size_t i) {
        return runCase(scenario_tree_, cases[i], folderOf(i), options_.keep_runs).toJson();
      },
      pool,
      [&](std::size_t i, const TaskEnd& end) {
        CaseResult result;
        if (end.kind == TaskEnd::Kind::kDone) {
          result = CaseResult::fromJson(end.answer);
        } else {
          result.id = cases[i].id;
          result.outcome =
              end.kind == TaskEnd::Kind::kCrashed ? CaseOutcome::kCrashed : CaseOutcome::kTimedOut;
          result.reason = end.kind == TaskEnd::Kind::kCrashed
                              ? end.trouble
                              : fmt::format("no end within {:g} s", options_.timeout_s);
          std::error_code ignored;
          if (!options_.keep_runs) fs::remove_all(folderOf(i), ignored);
        }
        log.append(result.toJson());
        ended(result);
      });
  if (!options_.keep_runs) fs::remove(options_.cases_folder, failed);  // empty now
}

}  // namespace ballbot
