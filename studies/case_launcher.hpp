#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "studies/case_result.hpp"
#include "studies/study_cases.hpp"

namespace ballbot {

/// Runs cases somewhere and records their results in the study's folder.
class CaseLauncher {
 public:
  virtual ~CaseLauncher() = default;
  /// Returns once each case has a record. `ended` hears of each when it is safe on disk.
  /// @throw InterruptedError, OutputError; what was recorded until then stays.
  virtual void launch(const std::vector<StudyCase>& cases,
                      const std::function<void(const CaseResult&)>& ended) = 0;
};

/// On this machine, each case in a process of its own.
class LocalLauncher final : public CaseLauncher {
 public:
  struct Options {
    std::string results_file;  ///< appended to
    std::string cases_folder;  ///< run folders are made below this
    int jobs = 1;
    double timeout_s = 600;
    bool keep_runs = false;
    const std::atomic<bool>* stop = nullptr;
  };
  LocalLauncher(ConfigNode scenario_tree, Options options)
      : scenario_tree_(std::move(scenario_tree)), options_(std::move(options)) {}

  void launch(const std::vector<StudyCase>& cases,
              const std::function<void(const CaseResult&)>& ended) override;

 private:
  ConfigNode scenario_tree_;
  Options options_;
};

}  // namespace ballbot
