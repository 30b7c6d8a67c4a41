#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "studies/case_launcher.hpp"
#include "studies/study_folder.hpp"

namespace ballbot {

/// Runs cases on a cluster as Slurm job arrays: every task of an array runs a chunk of cases, one
/// after the other, and appends to a result file of its own in the study's folder, which must be
/// visible to all nodes under the same path, as must this program. Slurm alone decides where and
/// when.
class SlurmLauncher final : public CaseLauncher {
 public:
  struct Options {
    std::string name;        ///< of the job
    int cases_per_task = 0;  ///< 0: chosen so that there are a few hundred tasks at most
    int submissions = 3;     ///< so often a case without result is submitted
    double timeout_s = 600;  ///< of a case
    std::vector<std::string> sbatch_options;  ///< e.g. "--partition=short"
    bool submit_only = false;                 ///< submit once and do not wait
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string&)> say;  ///< what was submitted, for a person
  };
  SlurmLauncher(const StudyFolder& folder, Options options)
      : folder_(folder), options_(std::move(options)) {}

  /// @throw InputError          if Slurm is not here or refuses the job
  /// @throw LostParticipantError if cases are without result after the last submission
  /// @throw InterruptedError    after Ctrl-C; jobs still queued are cancelled. With submit_only,
  ///                            after the submission: go on with --resume
  void launch(const std::vector<StudyCase>& cases,
              const std::function<void(const CaseResult&)>& ended) override;

 private:
  std::string submit(const std::vector<StudyCase>& cases);
  void waitFor(const std::string& job, const std::function<void()>& collect);

  const StudyFolder& folder_;
  Options options_;
};

/// What a task of the job array does: runs the cases listed in `chunk_file` that are not yet in
/// `results_file`.
void runChunk(const std::string& scenario_file, const std::string& chunk_file,
              const std::string& results_file, const std::string& cases_folder, double timeout_s,
              const std::atomic<bool>* stop);

}  // namespace ballbot
