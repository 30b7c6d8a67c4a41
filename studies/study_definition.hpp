#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/config_node.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// A configuration path and the value it gets. The value may hold `{from: AXIS, times: A, power:
/// P}` anywhere inside, which case generation replaces by A * (value of that axis)^P.
using Setting = std::pair<std::string, ConfigNode>;

/// One configuration path that follows the value of a numeric axis: factor * value^power.
struct LinkedPath {
  std::string path;
  double factor = 1;
  double power = 1;
};

/// One place on an axis.
struct AxisOption {
  std::string label;             ///< as tables and pictures show it: "40", "matched"
  std::optional<double> number;  ///< the label as a number, where it is one
  std::vector<Setting> settings;

  void describe(ConfigVisitor& v);
};

/// Numbers drawn by a Latin hypercube or searched by bisection.
struct AxisRange {
  double low = 0, high = 0;
  bool logarithmic = false;
  bool whole = false;  ///< only whole numbers

  double middle() const { return between(low, high); }
  /// In the middle of two values, on the range's scale.
  double between(double a, double b) const;
};

/// Something that is varied: one or more configuration paths that change together.
struct StudyAxis {
  std::string name, unit;
  std::vector<LinkedPath> paths;    ///< empty where options hold their own settings
  std::vector<AxisOption> options;  ///< of a grid
  std::optional<AxisRange> range;   ///< instead of options

  void describe(ConfigVisitor& v);

 private:
  void requireWhole(const ConfigReader& in) const;
};

/// Combinations that make no sense: left out are cases whose labels all stand in this.
struct Exclusion {
  std::vector<std::pair<std::string, std::vector<std::string>>> labels;  ///< by axis name
};

/// Where, along an axis, does the share of cases that pass cross `rate`?
struct SearchDefinition {
  std::string axis;
  double rate = 0.5;
  double resolution = 0.05;  ///< stop at this width of the bracket, relative to its upper end

  void describe(ConfigVisitor& v);
};

/// What the report of a study draws; empty members are chosen from the data.
struct ReportDefinition {
  std::string along;                 ///< axis drawn from left to right
  std::string curves;                ///< axis with a curve for each of its options
  std::vector<std::string> metrics;  ///< shown beside the share of cases that pass
  double rate = 0.5;                 ///< the boundary is where that share crosses this

  void describe(ConfigVisitor& v);
};

enum class StudyDesign { kGrid, kLatinHypercube };

/// A study file: one scenario, what is varied in it, and how often.
struct Study {
  std::string name, summary;
  std::string scenario;       ///< path of the scenario file
  std::vector<Setting> base;  ///< for all cases
  StudyDesign design = StudyDesign::kGrid;
  std::vector<StudyAxis> axes;
  std::vector<Exclusion> exclusions;
  int samples = 0;                      ///< of a Latin hypercube
  std::uint64_t design_seed = 1;        ///< of a Latin hypercube
  std::vector<std::uint64_t> seeds{1};  ///< every point runs once with each
  double timeout_s = 600;               ///< wall-clock time after which a case counts as hung
  std::optional<SearchDefinition> search;
  ReportDefinition report;
  ConfigNode tree = ConfigNode::map({});

  /// @throw InputError naming the axes there are.
  const StudyAxis& axis(const std::string& axis_name) const;
  std::size_t axisIndex(const std::string& axis_name) const;

  void describe(ConfigVisitor& v);

 private:
  void describeAxes(ConfigVisitor& v);
  void describeSampling(ConfigVisitor& v);
};

/// Reads a study file. docs/studies.md describes it.
/// @throw InputError with file, line and column.
Study loadStudy(const std::string& path);
/// The same of what such a file says. @param source  what errors call it
Study readStudy(ConfigNode tree, const std::string& source);

/// The options of a numeric axis at given values.
AxisOption optionAt(const StudyAxis& axis, double value);

}  // namespace ballbot
