#pragma once

#include <string>
#include <vector>

#include "studies/study_view.hpp"

namespace ballbot {

/// Where passing begins or ends along the view's axis, one sentence a curve, with intervals.
std::vector<std::string> studyAnswer(const Study& study, const StudyView& view);

/// What the other curves change against the first one: one sentence a curve, counted over all
/// panels. A difference counts only where one surely passes at a value at
/// which the other surely fails (95 % each). Empty where there is
/// nothing to compare: no curves, or none that crosses the level.
std::vector<std::string> studyComparison(const Study& study, const StudyView& view);

/// Each metric of study.report over the runs that did not fall: where its median is least and
/// largest; or, where the view's axis has words, its median at each step and the steps that change
/// it for certain.
std::vector<std::string> studyMetrics(const Study& study, const StudyView& view);

}  // namespace ballbot
