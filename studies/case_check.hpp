#pragma once

#include <vector>

#include "studies/study_cases.hpp"

namespace ballbot {

/// Reads every configuration of a study as its runs will.
/// @throw InputError that lists all that is wrong in any of them.
void checkCases(const Study& study, const ConfigNode& scenario_tree,
                const std::vector<StudyCase>& cases);

}  // namespace ballbot
