#pragma once

#include <string>
#include <vector>

#include "studies/study_view.hpp"

namespace ballbot {

/// A picture of a study, as it also stands in the page.
struct StudyFigure {
  std::string file;  ///< "smoke-1", without an ending
  std::string title;
  std::string svg;
};

/// One picture a panel: share of cases that pass with its 95 % interval, and each metric of
/// study.report with its median, least and largest value over the seeds, along the view's axis.
std::vector<StudyFigure> studyFigures(const Study& study, const StudyView& view);

/// "delay [ms]"
std::string withUnit(const std::string& name, const std::string& unit);

}  // namespace ballbot
