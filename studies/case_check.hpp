#pragma once

#include <vector>

#include "studies/study_cases.hpp"

namespace ballbot {

/// Reads every configuration of a study as its runs will.
/// @throw InputError that lists all that is wrong in any of them, or names a metric of the report
/// that no run has.
void checkCases(const Study& study, const ConfigNode& scenario_tree,
                const std::vector<StudyCase>& cases);

}  // namespace ballbot
