#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "studies/case_launcher.hpp"
#include "studies/result_table.hpp"
#include "studies/study_folder.hpp"

namespace ballbot {

/// Keeps a study's results: what is recorded is not run again.
class StudyEngine {
 public:
  /// @param progress  called when cases of a run() are done: how many of how many are
  StudyEngine(const Study& study, const StudyFolder& folder, CaseLauncher& launcher,
              std::function<void(std::size_t done, std::size_t count)> progress);

  /// Runs those of `cases` that have no result yet. @throw InterruptedError, OutputError
  void run(const std::vector<StudyCase>& cases);

  /// Every case asked for so far, in that order, each once.
  const std::vector<StudyCase>& cases() const { return cases_; }
  const std::map<std::string, CaseResult>& results() const { return results_; }
  const CaseResult& result(const StudyCase& c) const { return results_.at(c.id); }
  std::size_t ranNow() const { return ran_now_; }
  double cpuSecondsNow() const {
    return cpu_now_s_;
  }  ///< in runs, over all cases run by this process

  int count(CaseOutcome outcome) const;
  ResultTable table() const { return makeResultTable(study_, cases_, results_); }

 private:
  const Study& study_;
  CaseLauncher& launcher_;
  std::function<void(std::size_t, std::size_t)> progress_;
  std::map<std::string, CaseResult> results_;
  std::vector<StudyCase> cases_;
  std::map<std::string, std::size_t> known_;
  std::size_t ran_now_ = 0;
  double cpu_now_s_ = 0;
};

}  // namespace ballbot
