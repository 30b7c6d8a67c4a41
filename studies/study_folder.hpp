#pragma once

#include <map>
#include <string>

#include "studies/case_result.hpp"
#include "studies/study_definition.hpp"

namespace ballbot {

/// The folder one study leaves behind. One process at a time works on it.
class StudyFolder {
 public:
  /// Creates `wanted`, or, if empty, the next free `runs/<study>-NNN`, and writes down what is
  /// about to be run. @throw InputError if it exists and is not empty. @throw OutputError
  static StudyFolder create(const std::string& wanted, const Study& study,
                            const ConfigNode& scenario_tree);
  /// Opens one to go on with: `wanted`, or, if empty, the newest of this study below runs/.
  /// @throw InputError if there is none, if it holds another study, scenario or program version, or
  ///        if another process works on it.
  static StudyFolder resume(const std::string& wanted, const Study& study,
                            const ConfigNode& scenario_tree);
  ~StudyFolder();
  StudyFolder(StudyFolder&& other) noexcept : path_(std::move(other.path_)), lock_(other.lock_) {
    other.lock_ = -1;
  }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string scenarioFile() const { return path_ + "/scenario.yaml"; }
  std::string resultsFolder() const { return path_ + "/results"; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

  /// Everything recorded so far, by case; where a case stands twice, the later one in the order of
  /// file names and lines.
  std::map<std::string, CaseResult> results() const;
  /// Forgets cases that did not run (crash, timeout, error), so that they run again.
  void dropFailures() const;

 private:
  StudyFolder(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::string path_;
  int lock_ = -1;
};

}  // namespace ballbot
