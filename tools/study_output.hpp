#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "studies/study_search.hpp"

namespace ballbot {

/// What a study found beyond its table, and how long it took.
struct StudyFindings {
  std::vector<PlaceBoundary> boundaries;  ///< of a search
  double wall_s = 0;  ///< of this process, results that were there already not counted
  int jobs = 0;       ///< 0: elsewhere
};

/// Cases that did not run: crashed, hung, or ended in an error.
int failedCases(const StudyEngine& engine);

/// table.csv, table.h5, report.html and its figures, summary.json, commands.sh (every case alone)
/// and timing.json, in the folder.
/// @throw OutputError
void writeStudyOutput(const Study& study, const StudyEngine& engine, const StudyFolder& folder,
                      const StudyFindings& findings);

/// What `--json` prints.
nlohmann::ordered_json studySummary(const Study& study, const StudyEngine& engine,
                                    const StudyFolder& folder, const StudyFindings& findings);
/// The same for people.
std::string studyText(const Study& study, const StudyEngine& engine, const StudyFolder& folder,
                      const StudyFindings& findings);

}  // namespace ballbot
