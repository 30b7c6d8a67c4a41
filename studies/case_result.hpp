#pragma once

#include <map>
#include <string>
#include <vector>

namespace ballbot {

/// How a case ended. The first three are results of a run; of the others there is no run to judge.
enum class CaseOutcome {
  kPassed,
  kMissed,    ///< a requirement of the scenario was missed
  kFell,      ///< the robot fell
  kError,     ///< the run ended in an error that it could put into words
  kCrashed,   ///< its process died
  kTimedOut,  ///< no end within the study's timeout
};

const char* toText(CaseOutcome outcome);
/// Whether the case ran: it has metrics and a trajectory digest.
inline bool ran(CaseOutcome outcome) { return outcome <= CaseOutcome::kFell; }

/// What became of one case.
struct CaseResult {
  std::string id;
  CaseOutcome outcome = CaseOutcome::kError;
  std::string reason;  ///< why it did not pass, in words; empty if it passed
  double simulated_s = 0;
  std::map<std::string, double> metrics;
  std::string trajectory_digest;
  double cpu_s = 0;  ///< processor time of its run, a fact of the machine: never in a table

  std::string toJson() const;
  /// @throw InputError if `text` is not what toJson() writes.
  static CaseResult fromJson(const std::string& text);
};

}  // namespace ballbot
