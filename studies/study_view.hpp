#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studies/boundary_search.hpp"
#include "studies/case_result.hpp"
#include "studies/study_cases.hpp"

namespace ballbot {

/// A metric over the seeds at one place.
struct MetricSpread {
  double low = 0, middle = 0, high = 0;  ///< least, median, largest
};

/// The cases of one option of the curve axis, in order of the axis drawn from left to right.
struct StudyCurve {
  std::string name;
  struct Point {
    std::string label;
    double value = 0;  ///< along the axis; its position in the list where the axis has no numbers
    RateEstimate rate;
    std::vector<const CaseResult*> results;

    /// Over the runs that did not fall: others end early. Empty if none of them has the metric.
    std::optional<MetricSpread> spread(const std::string& metric) const;
  };
  std::vector<Point> points;

  /// Where the rate of passing crosses `rate` along the curve; unknown with fewer than two points
  /// at which a case ran.
  Boundary boundary(double rate) const;
};

/// The rate of passing among the cases that ran: a crash or a timeout is a fact of the machine and
/// says nothing about the robot.
RateEstimate rateOf(const std::vector<const CaseResult*>& results);

/// What is drawn together: all axes but two stand still.
struct StudyPanel {
  std::string name;  ///< "torque_weight 2, delay 5 ms"; empty if there are no other axes
  std::vector<StudyCurve> curves;
};

/// A study's results arranged for a reader.
struct StudyView {
  const StudyAxis* along = nullptr;   ///< null: a study without axes
  const StudyAxis* curves = nullptr;  ///< null: one curve
  bool numeric = false;               ///< `along` has numbers, not words
  std::vector<StudyPanel> panels;
};

/// What a curve is called: its label, with axis and unit where that is a number; "all" if there is
/// but one.
std::string curveLabel(const StudyView& view, const StudyCurve& curve);

/// By study.report; where it leaves things open, the numeric axis with the most options is drawn
/// along, and the axis with the fewest of the others makes the curves.
StudyView arrange(const Study& study, const std::vector<StudyCase>& cases,
                  const std::map<std::string, CaseResult>& results);

}  // namespace ballbot
