#pragma once

#include <string>

namespace ballbot {

/// The folder one run leaves behind. Everything in it but timing.json is byte-identical when the
/// same scenario is run again.
class RunFolder {
 public:
  /// Creates `wanted`, or, if empty, the next free `runs/<scenario>-NNN` below the working folder.
  /// @throw InputError if `wanted` exists and is not empty. @throw OutputError
  static RunFolder create(const std::string& wanted, const std::string& scenario_name);
  /// @throw InputError if `path` is not a run folder.
  static RunFolder open(const std::string& path);

  /// Takes a folder away in which nothing has been recorded, and its content with it.
  void discardUnlessRecorded() const;

  const std::string& path() const { return path_; }
  std::string scenarioFile() const { return path_ + "/scenario.yaml"; }
  std::string manifestFile() const { return path_ + "/manifest.json"; }
  std::string logFile() const { return path_ + "/run.lcmlog"; }
  std::string summaryFile() const { return path_ + "/summary.json"; }
  std::string timingFile() const { return path_ + "/timing.json"; }
  /// Of a run that continues another: what it began with.
  std::string startFile() const { return path_ + "/start.checkpoint"; }
  std::string checkpointsFolder() const { return path_ + "/checkpoints"; }
  std::string reportFile() const { return path_ + "/report.html"; }

 private:
  explicit RunFolder(std::string path) : path_(std::move(path)) {}
  std::string path_;
};

}  // namespace ballbot
