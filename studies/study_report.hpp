#pragma once

#include <string>
#include <vector>

#include "studies/study_search.hpp"
#include "studies/study_view.hpp"

namespace ballbot {

/// A picture of a study, as it also stands in the page.
struct StudyFigure {
  std::string file;  ///< "success-1.svg"
  std::string title;
  std::string svg;
};

/// Share of cases that pass with its 95 % interval, and each metric of study.report with its
/// median, least and largest value over the seeds, along the view's axis.
std::vector<StudyFigure> studyFigures(const Study& study, const StudyView& view);

/// What the study says, in sentences: where passing begins or ends for each curve, with intervals,
/// and what the curves differ by.
std::vector<std::string> studyAnswer(const Study& study, const StudyView& view);

/// The study's page: one HTML file that needs no network and no file beside it. The same results
/// give the same bytes.
std::string studyPage(const Study& study, const StudyEngine& engine,
                      const std::vector<PlaceBoundary>& boundaries);

}  // namespace ballbot
