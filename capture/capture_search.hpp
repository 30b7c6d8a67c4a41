#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/capture_study.hpp"
#include "studies/boundary_search.hpp"
#include "studies/study_engine.hpp"
#include "studies/study_search.hpp"

namespace ballbot {

/// What was found in one direction.
struct CaptureEdge {
  std::size_t variant = 0, duration = 0, height = 0;  ///< in the lists of the request
  int direction = 0;
  Boundary boundary;  ///< [N]; estimate and interval as BoundarySearch gives them
  /// The largest force up to which all that were tried are survived, and the smallest that is not
  /// [N]. Without the second all are; without the first not even none is.
  std::optional<double> survived_N, fallen_N;
};

/// Bisects the force in every direction of every variant, duration and height at once. It asks for
/// cases and looks up their results; what it asks for next depends on results alone.
class CaptureSearch {
 public:
  /// @param up_to_N  largest force looked at, for each duration and height:
  ///                 [duration * heights + height]
  CaptureSearch(const CaptureRequest& request, const Study& study, std::vector<double> up_to_N);

  /// To be run next; empty once all is known.
  std::vector<StudyCase> next();
  /// Looks up the results of what next() gave.
  void take(const StudyEngine& engine);
  /// About how many more cases will be asked for, those of the last next() included.
  std::size_t casesLeft() const;

  std::vector<CaptureEdge> edges() const;
  /// The same as the boundaries of the study behind it.
  std::vector<PlaceBoundary> boundaries() const;

 private:
  struct Line {
    std::size_t variant, duration, height;
    int direction;
    BoundarySearch search;
  };
  struct Question {
    std::size_t line;
    double steps;  ///< of the force, whole multiples of the resolution
    std::vector<StudyCase> cases;
  };
  std::vector<StudyCase> casesOf(const Line& line, double steps) const;

  const CaptureRequest request_;
  const Study& study_;
  std::vector<Line> lines_;
  std::vector<Question> asked_;
  bool at_rest_ = true;  ///< still to be asked: no force at all, the same in all directions
};

}  // namespace ballbot
