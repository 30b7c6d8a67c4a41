// What a study file says: its keys, and values of kinds that only studies have.
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "studies/setting_text.hpp"
#include "studies/study_definition.hpp"

namespace ballbot {
namespace {

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

std::vector<Setting> readSettings(const ConfigNode& node) {
  if (node.kind() != ConfigNode::Kind::kMap) {
    throw InputError(
        fmt::format("{}: 'set' must map configuration paths to values, e.g. "
                    "'plant.fidelity.friction: false'",
                    toText(node.where())));
  }
  return node.entries();
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

std::vector<std::uint64_t> readSeeds(const ConfigNode& node) {
  std::vector<std::uint64_t> seeds;
  const auto add = [&](const ConfigNode& item) {
    const auto seed = item.quoted() ? std::nullopt : parseWhole(item.text());
    if (!seed || *seed < 0) {
      throw InputError(
          fmt::format("{}: a seed must be a whole number, not negative", toText(item.where())));
    }
    seeds.push_back(static_cast<std::uint64_t>(*seed));
  };
  if (node.kind() == ConfigNode::Kind::kList) {
    for (const ConfigNode& item : node.items()) add(item);
  } else {
    const auto count = asNumber(node);
    if (!count || *count < 1 || *count > 1e6 || *count != std::floor(*count)) {
      throw InputError(fmt::format("{}: 'seeds' must be how many (1, 2, ...) or a list of seeds",
                                   toText(node.where())));
    }
    for (std::uint64_t s = 1; s <= static_cast<std::uint64_t>(*count); ++s) seeds.push_back(s);
  }
  if (std::set<std::uint64_t>(seeds.begin(), seeds.end()).size() != seeds.size() || seeds.empty()) {
    throw InputError(fmt::format("{}: 'seeds' must be different from each other, and at least one",
                                 toText(node.where())));
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

void describeSettings(ConfigVisitor& v, const char* words, std::vector<Setting>& out) {
  v.other(may("set", words), "mapping from configuration paths to values",
          [&](ConfigReader& in) { out = readSettings(*in.raw("set")); });
}

/// `range` of an axis, and what belongs to it.
void describeRange(ConfigVisitor& v, std::optional<AxisRange>& out) {
  AxisRange r;
  std::array<double, 2> ends{};
  v.numbers(may("range", "instead of values: lowest and highest, to be drawn from or searched in"),
            ends.data(), ends.size());
  v.choice(may("scale", "on which is drawn and searched"), r.logarithmic,
           {{"linear", false}, {"log", true}});
  v.boolean(may("whole", "only whole numbers of the range"), r.whole);
  r.low = ends[0];
  r.high = ends[1];
  v.check([&](const ConfigReader& in) {
    for (const char* key : {"scale", "whole"}) {
      if (in.has(key) && !in.has("range")) throw InputError(in.at(key) + " belongs to a 'range'");
    }
    if (!in.has("range")) return;
    if (!(r.low < r.high)) {
      throw InputError(
          fmt::format("{} is [{}, {}], the second must be larger", in.at("range"), r.low, r.high));
    }
    if (r.logarithmic && r.low <= 0) {
      throw InputError(
          fmt::format("{} begins at {}, must be positive with scale: log", in.at("range"), r.low));
    }
  });
  if (r.low < r.high) out = r;
}

}  // namespace

AxisOption optionAt(const StudyAxis& axis, double value) {
  return valueOption(axis,
                     ConfigNode::scalar(numberText(value), false, {"axis " + axis.name, 0, 0}));
}

void AxisOption::describe(ConfigVisitor& v) {
  v.text(must("label", "as tables and pictures show it"), label);
  describeSettings(v, "what it sets", settings);
}

void StudyAxis::describe(ConfigVisitor& v) {
  v.fileName(must("name", "column of the tables"), name);
  v.text(may("unit", "of its values"), unit);
  v.other(may("paths", "what its values are given to"),
          "configuration path, or list of such and of {path: P, times: A, power: N}",
          [this](ConfigReader& in) { paths = readPaths(*in.raw("paths")); });
  v.other(may("values", "one after the other"), "list", [this](ConfigReader& in) {
    const ConfigNode& values = *in.raw("values");
    if (values.kind() != ConfigNode::Kind::kList || values.items().empty()) {
      throw InputError(
          fmt::format("{}: 'values' must be a list with something in it", toText(values.where())));
    }
    for (const ConfigNode& value : values.items()) options.push_back(valueOption(*this, value));
  });
  v.list(may("options", "instead of values: settings that change together"),
         [this](ConfigVisitor& in) {
           options.emplace_back();
           options.back().describe(in);
         });
  describeRange(v, range);
  v.check([this](const ConfigReader& in) { requireWhole(in); });
}

void StudyAxis::requireWhole(const ConfigReader& in) const {
  const bool values = in.has("values"), ranged = range.has_value();
  if (values == in.has("options") && (values || !ranged)) {
    throw InputError(fmt::format(
        "{}: axis '{}' must have either 'values' (or 'range') for its 'paths', or 'options'",
        in.at("name"), name));
  }
  if ((values || ranged) && paths.empty()) {
    throw InputError(
        fmt::format("{}: axis '{}' has no 'paths': which configuration values does it change?",
                    in.at("name"), name));
  }
  std::set<std::string> labels;
  for (const AxisOption& option : options) {
    if (!labels.insert(option.label).second) {
      throw InputError(
          fmt::format("{}: axis '{}' has '{}' twice", in.at("name"), name, option.label));
    }
  }
}

void SearchDefinition::describe(ConfigVisitor& v) {
  v.text(must("axis", "along which is searched; it has a range"), axis);
  v.number(may("rate", "of seeds that pass, which is crossed there"), rate, {0.01, 0.99});
  v.number(may("resolution", "width of the bracket at the end, relative to its upper end"),
           resolution, {1e-4, 1});
}

void ReportDefinition::describe(ConfigVisitor& v) {
  v.text(may("along", "axis drawn from left to right"), along);
  v.text(may("curves", "axis with a curve for each of its options"), curves);
  v.number(may("rate", "the boundary is where the share that passes crosses it"), rate,
           {0.01, 0.99});
  v.other(may("metrics", "shown beside the share of cases that pass"), "list of metrics",
          [this](ConfigReader& in) {
            for (const ConfigNode& item : in.raw("metrics")->items())
              metrics.push_back(requireText(item, "a metric"));
          });
}

void Study::describe(ConfigVisitor& v) {
  v.fileName(must("name", "of the study's folder"), name);
  v.text(may("summary", "a line for the report"), summary);
  v.other(must("scenario", "which is run many times"), "file, beside this one",
          [this](ConfigReader& in) {
            const std::filesystem::path file = in.text("scenario");
            const std::filesystem::path beside(in.raw("scenario")->where().source);
            scenario = (beside.parent_path() / file).lexically_normal().string();
          });
  describeSettings(v, "for all cases; paths are those of --set", base);
  v.choice(may("design", "every combination of the axes' values, or points drawn from ranges"),
           design,
           {{"grid", StudyDesign::kGrid}, {"latin_hypercube", StudyDesign::kLatinHypercube}});
  describeAxes(v);
  v.other(may("seeds", "of which each case is run with every one"),
          "how many, from 1 on, or a list of seeds",
          [this](ConfigReader& in) { seeds = readSeeds(*in.raw("seeds")); });
  v.number(may("timeout_s", "of wall-clock time, after which a case counts as hung"), timeout_s,
           {0.1, 1e6});
  describeSampling(v);
  v.section(may("search", "bisects for the place where passing begins or ends"),
            [this](ConfigVisitor& in) {
              SearchDefinition s;
              s.describe(in);
              in.check([&](const ConfigReader& at) {
                if (axis(s.axis).range) return;
                throw InputError(fmt::format("{}: axis '{}' has no 'range' to search in",
                                             at.at("axis"), s.axis));
              });
              search = s;
            });
  v.section(may("report", "what is drawn; chosen from the data where nothing is said"),
            [this](ConfigVisitor& in) {
              report.describe(in);
              in.check([this](const ConfigReader&) {
                for (const std::string& name_of_axis : {report.along, report.curves}) {
                  if (!name_of_axis.empty()) axis(name_of_axis);
                }
              });
            });
}

void Study::describeAxes(ConfigVisitor& v) {
  v.list(may("axes", "what is varied"), [this](ConfigVisitor& in) {
    StudyAxis axis;
    axis.describe(in);
    axes.push_back(std::move(axis));
  });
  StudyAxis variant;
  variant.name = "variant";
  v.list(may("cases", "a plain list, whose axis is called variant"), [&](ConfigVisitor& in) {
    variant.options.emplace_back();
    variant.options.back().describe(in);
  });
  if (!variant.options.empty()) axes.push_back(std::move(variant));
  v.other(may("exclude", "combinations that make no sense"), "list of {AXIS: label or labels, ...}",
          [this](ConfigReader& in) {
            for (const ConfigNode& item : in.raw("exclude")->items())
              exclusions.push_back(readExclusion(item, *this));
          });
}

void Study::describeSampling(ConfigVisitor& v) {
  v.integer(may("samples", "of a Latin hypercube"), samples, {1, 1e6});
  auto drawn_with = static_cast<std::int64_t>(design_seed);
  v.whole(may("design_seed", "of a Latin hypercube"), drawn_with, {0, kInf});
  design_seed = static_cast<std::uint64_t>(drawn_with);
  v.check([this](const ConfigReader& in) {
    const bool sampled = design == StudyDesign::kLatinHypercube;
    if (sampled && !in.has("samples")) {
      throw InputError(in.at("samples") + " is missing: design: latin_hypercube needs it");
    }
    for (const char* key : {"samples", "design_seed"}) {
      if (!sampled && in.has(key)) {
        throw InputError(in.at(key) + " belongs to design: latin_hypercube");
      }
    }
  });
}

}  // namespace ballbot
