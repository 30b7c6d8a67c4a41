#pragma once

#include <vector>

#include "studies/boundary_search.hpp"
#include "studies/study_engine.hpp"

namespace ballbot {

/// The boundary at one place of the axes that are not searched.
struct PlaceBoundary {
  std::vector<AxisPoint> place;  ///< one per axis; the searched one is empty
  Boundary boundary;
};

/// Cases at both ends and in the middle of the search range, to be checked before anything runs.
std::vector<StudyCase> searchProbeCases(const Study& study);

/// Bisects `study.search` at every place of the grid of the other axes, all places at once, so that
/// there is work for every job. What is asked for next depends on results alone: a resumed search
/// takes the same way.
std::vector<PlaceBoundary> runSearch(const Study& study, StudyEngine& engine);

/// "falls below 50 % at 8.4 Hz (95 %: 8.1 to 8.9 Hz)"
std::string toText(const Boundary& boundary, double rate, const std::string& unit);

}  // namespace ballbot
