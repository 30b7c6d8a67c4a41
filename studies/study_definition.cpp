#include "studies/study_definition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config_reader.hpp"
#include "core/config_values.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/yaml_file.hpp"
#include "studies/setting_text.hpp"

namespace ballbot {
namespace {

// The columns of makeResultTable() beside axes and metrics.
constexpr std::array<std::string_view, 6> kFixedColumns = {
    "case", "seed", "outcome", "reason", "simulated_s", "trajectory_digest"};

std::optional<double> asNumber(const ConfigNode& node) {
  if (node.kind() != ConfigNode::Kind::kScalar || node.quoted()) return std::nullopt;
  const std::optional<double> value = parseNumber(node.text());
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string requireText(const ConfigNode& node, const std::string& what) {
  if (node.kind() != ConfigNode::Kind::kScalar) {
    throw InputError(fmt::format("{}: {} must be one word, not {}", toText(node.where()), what,
                                 node.kindName()));
  }
  return node.text();
}

std::vector<Setting> readSettings(const ConfigNode* node) {
  if (!node) return {};
  if (node->kind() != ConfigNode::Kind::kMap) {
    throw InputError(
        fmt::format("{}: 'set' must map configuration paths to values, e.g. "
                    "'plant.fidelity.friction: false'",
                    toText(node->where())));
  }
  return node->entries();
}

std::vector<LinkedPath> readPaths(const ConfigNode& node) {
  if (node.kind() == ConfigNode::Kind::kScalar) return {{node.text(), 1, 1}};
  if (node.kind() != ConfigNode::Kind::kList || node.items().empty()) {
    throw InputError(
        fmt::format("{}: 'paths' must list configuration paths", toText(node.where())));
  }
  std::vector<LinkedPath> out;
  for (const ConfigNode& item : node.items()) {
    if (item.kind() == ConfigNode::Kind::kScalar) {
      out.push_back({item.text(), 1, 1});
      continue;
    }
    ConfigReader in(item, "paths");
    LinkedPath path;
    path.path = in.text("path");
    path.factor = in.numberOr("times", 1);
    path.power = in.numberOr("power", 1);
    in.finish();
    out.push_back(path);
  }
  return out;
}

AxisRange readRange(ConfigReader& in) {
  AxisRange r;
  const auto ends = in.numbers<2>("range");
  r.low = ends[0];
  r.high = ends[1];
  r.logarithmic = in.choiceOr("scale", false, {{"linear", false}, {"log", true}});
  r.whole = in.booleanOr("whole", false);
  if (!(r.low < r.high)) {
    throw InputError(
        fmt::format("{} is [{}, {}], the second must be larger", in.at("range"), r.low, r.high));
  }
  if (r.logarithmic && r.low <= 0) {
    throw InputError(
        fmt::format("{} begins at {}, must be positive with scale: log", in.at("range"), r.low));
  }
  return r;
}

/// A value among `values`: the paths of the axis get it as it stands.
AxisOption valueOption(const StudyAxis& axis, const ConfigNode& value) {
  AxisOption option;
  option.label = value.kind() == ConfigNode::Kind::kScalar ? value.text() : toFlowYaml(value);
  option.number = asNumber(value);
  for (const LinkedPath& path : axis.paths) {
    if (path.factor == 1 && path.power == 1) {
      option.settings.emplace_back(path.path, value);
    } else if (option.number) {
      const double scaled = path.factor * std::pow(*option.number, path.power);
      option.settings.emplace_back(path.path,
                                   ConfigNode::scalar(numberText(scaled), false, value.where()));
    } else {
      throw InputError(fmt::format("{}: '{}' is not a number, so '{}' cannot be computed from it",
                                   toText(value.where()), option.label, path.path));
    }
  }
  return option;
}

std::vector<AxisOption> readOptions(const ConfigNode& node) {
  if (node.kind() != ConfigNode::Kind::kList) {
    throw InputError(fmt::format("{}: must be a list of '{{label: ..., set: {{path: value}}}}'",
                                 toText(node.where())));
  }
  std::vector<AxisOption> out;
  for (const ConfigNode& item : node.items()) {
    ConfigReader in(item, "options");
    AxisOption option;
    option.label = in.text("label");
    option.settings = readSettings(in.raw("set"));
    in.finish();
    out.push_back(std::move(option));
  }
  return out;
}

StudyAxis readAxis(ConfigReader& in) {
  StudyAxis axis;
  axis.name = readFileName(in, "name");
  axis.unit = in.textOr("unit", "");
  const ConfigNode* paths = in.raw("paths");
  const ConfigNode* values = in.raw("values");
  const ConfigNode* options = in.raw("options");
  if (paths) axis.paths = readPaths(*paths);
  if (in.has("range")) axis.range = readRange(in);
  in.finish();
  const int kinds = (values != nullptr) + (options != nullptr);
  if (kinds > 1 || (kinds == 0 && !axis.range)) {
    throw InputError(fmt::format(
        "{}must have either 'values' (or 'range') for its 'paths', or 'options'", in.at("name")));
  }
  if ((values || axis.range) && !paths) {
    throw InputError(
        fmt::format("{}has no 'paths': which configuration values does it change?", in.at("name")));
  }
  if (values) {
    if (values->kind() != ConfigNode::Kind::kList || values->items().empty()) {
      throw InputError(
          fmt::format("{}: 'values' must be a list with something in it", toText(values->where())));
    }
    for (const ConfigNode& value : values->items())
      axis.options.push_back(valueOption(axis, value));
  }
  if (options) axis.options = readOptions(*options);
  std::set<std::string> labels;
  for (const AxisOption& option : axis.options) {
    if (!labels.insert(option.label).second) {
      throw InputError(fmt::format("{}has '{}' twice", in.at("name"), option.label));
    }
  }
  return axis;
}

std::vector<std::uint64_t> readSeeds(ConfigReader& in) {
  const ConfigNode* node = in.raw("seeds");
  std::vector<std::uint64_t> seeds;
  const auto add = [&](const ConfigNode& item) {
    const auto seed = item.quoted() ? std::nullopt : parseWhole(item.text());
    if (!seed || *seed < 0) {
      throw InputError(
          fmt::format("{}: a seed must be a whole number, not negative", toText(item.where())));
    }
    seeds.push_back(static_cast<std::uint64_t>(*seed));
  };
  if (!node) return {1};
  if (node->kind() == ConfigNode::Kind::kList) {
    for (const ConfigNode& item : node->items()) add(item);
  } else {
    const auto count = asNumber(*node);
    if (!count || *count < 1 || *count > 1e6 || *count != std::floor(*count)) {
      throw InputError(fmt::format("{}: 'seeds' must be how many (1, 2, ...) or a list of seeds",
                                   toText(node->where())));
    }
    for (std::uint64_t s = 1; s <= static_cast<std::uint64_t>(*count); ++s) seeds.push_back(s);
  }
  if (std::set<std::uint64_t>(seeds.begin(), seeds.end()).size() != seeds.size() || seeds.empty()) {
    throw InputError(fmt::format("{}: 'seeds' must be different from each other, and at least one",
                                 toText(node->where())));
  }
  return seeds;
}

Exclusion readExclusion(const ConfigNode& node, const Study& study) {
  if (node.kind() != ConfigNode::Kind::kMap) {
    throw InputError(
        fmt::format("{}: an exclusion maps axes to labels, e.g. '{{by: gain, bandwidth: [5, 6]}}'",
                    toText(node.where())));
  }
  Exclusion out;
  for (const auto& [axis, labels] : node.entries()) {
    const StudyAxis& on = study.axis(axis);
    std::vector<std::string> texts;
    if (labels.kind() == ConfigNode::Kind::kList) {
      for (const ConfigNode& label : labels.items()) texts.push_back(requireText(label, "a label"));
    } else {
      texts.push_back(requireText(labels, "a label"));
    }
    for (const std::string& text : texts) {
      bool known = false;
      for (const AxisOption& option : on.options) known = known || option.label == text;
      if (!known)
        throw InputError(
            fmt::format("{}: axis '{}' has no '{}'", toText(labels.where()), axis, text));
    }
    out.labels.emplace_back(axis, std::move(texts));
  }
  return out;
}

SearchDefinition readSearch(ConfigReader in, const Study& study) {
  SearchDefinition s;
  s.axis = in.text("axis");
  s.rate = in.numberOr("rate", s.rate, {0.01, 0.99});
  s.resolution = in.numberOr("resolution", s.resolution, {1e-4, 1});
  in.finish();
  if (!study.axis(s.axis).range) {
    throw InputError(fmt::format("{}axis '{}' has no 'range' to search in", in.at("axis"), s.axis));
  }
  return s;
}

ReportDefinition readReport(ConfigReader in, const Study& study) {
  ReportDefinition r;
  r.along = in.textOr("along", "");
  r.curves = in.textOr("curves", "");
  r.rate = in.numberOr("rate", r.rate, {0.01, 0.99});
  if (const ConfigNode* metrics = in.raw("metrics")) {
    for (const ConfigNode& item : metrics->items())
      r.metrics.push_back(requireText(item, "a metric"));
  }
  in.finish();
  for (const std::string& name : {r.along, r.curves}) {
    if (!name.empty()) study.axis(name);
  }
  return r;
}

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

AxisOption optionAt(const StudyAxis& axis, double value) {
  return valueOption(axis,
                     ConfigNode::scalar(numberText(value), false, {"axis " + axis.name, 0, 0}));
}

Study loadStudy(const std::string& path) {
  if (std::filesystem::is_directory(path)) {
    throw InputError(fmt::format(
        "{}: is a folder; a study is a YAML file such as configs/studies/smoke.yaml", path));
  }
  Study s;
  s.tree = loadYamlFile(path);
  if (s.tree.kind() != ConfigNode::Kind::kMap) {
    throw InputError(fmt::format("{}: a study must be a mapping of keys to values", path));
  }
  ConfigReader in(s.tree);
  s.name = readFileName(in, "name");
  s.summary = in.textOr("summary", "");
  in.text("scenario");
  const ConfigNode& scenario = *in.raw("scenario");
  const std::filesystem::path folder = std::filesystem::path(scenario.where().source).parent_path();
  s.scenario = (folder / scenario.text()).lexically_normal().string();
  s.base = readSettings(in.raw("set"));
  s.design = in.choiceOr(
      "design", s.design,
      {{"grid", StudyDesign::kGrid}, {"latin_hypercube", StudyDesign::kLatinHypercube}});
  for (ConfigReader axis : in.list("axes")) s.axes.push_back(readAxis(axis));
  if (const ConfigNode* cases = in.raw("cases"))
    s.axes.push_back({"variant", "", {}, readOptions(*cases), {}});
  std::set<std::string> names;
  for (const StudyAxis& axis : s.axes) {
    if (!names.insert(axis.name).second)
      throw InputError(fmt::format("{}: two axes are called '{}'", path, axis.name));
    if (std::count(kFixedColumns.begin(), kFixedColumns.end(), axis.name) > 0) {
      throw InputError(fmt::format(
          "{}: an axis is called '{}', as a column that every table has; give it another name",
          path, axis.name));
    }
  }
  if (const ConfigNode* exclude = in.raw("exclude")) {
    for (const ConfigNode& item : exclude->items()) s.exclusions.push_back(readExclusion(item, s));
  }
  s.seeds = readSeeds(in);
  s.timeout_s = in.numberOr("timeout_s", s.timeout_s, {0.1, 1e6});
  const bool sampled = s.design == StudyDesign::kLatinHypercube;
  s.samples = sampled ? in.integer("samples", {1, 1e6}) : 0;
  if (sampled && in.has("design_seed")) {
    s.design_seed = static_cast<std::uint64_t>(readWhole(in, "design_seed", {0, kLargestWhole}));
  }
  if (in.has("search")) s.search = readSearch(in.child("search"), s);
  if (in.has("report")) s.report = readReport(in.child("report"), s);
  in.finish();
  for (const StudyAxis& axis : s.axes) {
    const bool searched = s.search && s.search->axis == axis.name;
    if (axis.options.empty() && !sampled && !searched) {
      throw InputError(fmt::format(
          "{}: axis '{}' has a 'range', which needs 'design: latin_hypercube' or a 'search'; "
          "a grid needs 'values'",
          path, axis.name));
    }
  }
  return s;
}

}  // namespace ballbot
