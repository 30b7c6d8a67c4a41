#include "studies/study_definition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

// The columns of makeResultTable() beside axes and metrics.
constexpr std::array<std::string_view, 6> kFixedColumns = {
    "case", "seed", "outcome", "reason", "simulated_s", "trajectory_digest"};

}  // namespace

double AxisRange::between(double a, double b) const {
  const double value = logarithmic ? std::sqrt(a * b) : 0.5 * (a + b);
  return whole ? std::round(value) : value;
}

std::size_t Study::axisIndex(const std::string& axis_name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].name == axis_name) return i;
    names.push_back(axes[i].name);
  }
  throw InputError(fmt::format("{}: there is no axis '{}'; there are: {}", toText(tree.where()),
                               axis_name, fmt::join(names, ", ")));
}

const StudyAxis& Study::axis(const std::string& axis_name) const {
  return axes[axisIndex(axis_name)];
}

Study loadStudy(const std::string& path) {
  if (std::filesystem::is_directory(path)) {
    throw InputError(fmt::format(
        "{}: is a folder; a study is a YAML file such as configs/studies/smoke.yaml", path));
  }
  return readStudy(loadYamlFile(path), path);
}

Study readStudy(ConfigNode tree, const std::string& source) {
  Study s;
  s.tree = std::move(tree);
  if (s.tree.kind() != ConfigNode::Kind::kMap) {
    throw InputError(fmt::format("{}: a study must be a mapping of keys to values", source));
  }
  ConfigReader in(s.tree);
  readDescribed(in, s);
  in.finish();
  std::set<std::string> names;
  for (const StudyAxis& axis : s.axes) {
    if (!names.insert(axis.name).second)
      throw InputError(fmt::format("{}: two axes are called '{}'", source, axis.name));
    if (std::count(kFixedColumns.begin(), kFixedColumns.end(), axis.name) > 0) {
      throw InputError(fmt::format(
          "{}: an axis is called '{}', as a column that every table has; give it another name",
          source, axis.name));
    }
  }
  const bool sampled = s.design == StudyDesign::kLatinHypercube;
  for (const StudyAxis& axis : s.axes) {
    const bool searched = s.search && s.search->axis == axis.name;
    if (axis.options.empty() && !sampled && !searched) {
      throw InputError(fmt::format(
          "{}: axis '{}' has a 'range', which needs 'design: latin_hypercube' or a 'search'; "
          "a grid needs 'values'",
          source, axis.name));
    }
  }
  return s;
}

}  // namespace ballbot
