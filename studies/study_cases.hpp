#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/study_definition.hpp"

namespace ballbot {

/// Where a case stands on one axis.
struct AxisPoint {
  std::string label;
  double number = 0;  ///< NaN where the label is no number
};

/// One run of a study: a configuration and a seed.
struct StudyCase {
  std::string id;  ///< 16 hexadecimal digits, the digest of overrides and seed
  std::uint64_t seed = 1;
  std::vector<AxisPoint> point;        ///< one per axis, in the study's order
  std::vector<std::string> overrides;  ///< "path=value", as for --set

  /// "bandwidth 40 Hz, shaping off, seed 3"
  std::string describe(const Study& study) const;
  /// The command that runs this case alone.
  std::vector<std::string> command(const std::string& scenario_path) const;
};

/// All cases of a grid or Latin hypercube, in the order of the study file: the last axis changes
/// fastest, seeds fastest of all. A function of the study alone.
/// @throw InputError if an expression cannot be computed or two cases are the same.
std::vector<StudyCase> generateCases(const Study& study);

/// The cases of all seeds at one place, given an option of each axis.
std::vector<StudyCase> casesAt(const Study& study, const std::vector<AxisOption>& place);

/// Every combination of the axes' options but those excluded; an axis without options (one that is
/// searched) contributes an empty place holder.
std::vector<std::vector<AxisOption>> gridPlaces(const Study& study);

/// Latin hypercube in [0, 1)^dimensions: cut into `samples` slices along any axis, each slice holds
/// exactly one sample. [sample][dimension]; the same for the same seed on any machine.
std::vector<std::vector<double>> latinHypercube(int samples, int dimensions, std::uint64_t seed);

}  // namespace ballbot
