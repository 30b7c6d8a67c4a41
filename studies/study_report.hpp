#pragma once

#include <string>
#include <vector>

#include "studies/study_search.hpp"

namespace ballbot {

/// The study's page: one HTML file that needs no network and no file beside it. The same results
/// give the same bytes.
std::string studyPage(const Study& study, const StudyEngine& engine,
                      const std::vector<PlaceBoundary>& boundaries);

}  // namespace ballbot
