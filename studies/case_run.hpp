#pragma once

#include <string>

#include "core/config_node.hpp"
#include "studies/case_result.hpp"
#include "studies/study_cases.hpp"

namespace ballbot {

/// Runs one case in this process, as `ballbot run --in-process` would.
/// @param scenario_tree  of the study's scenario, overrides not yet applied
/// @param folder  where its run folder is made
/// @param keep    false: no log and no report are written, and the folder is removed again
CaseResult runCase(const ConfigNode& scenario_tree, const StudyCase& c, const std::string& folder,
                   bool keep);

}  // namespace ballbot
