#include "studies/study_cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config_reader.hpp"
#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/random.hpp"
#include "studies/setting_text.hpp"

namespace ballbot {
namespace {

/// Whether a mapping stands for the number of an axis. Other mappings may have a `from` of their
/// own, as the connections of FMUs do.
bool isExpression(const ConfigNode& map, const Study& study) {
  const ConfigNode* from = map.find("from");
  if (!from) return false;
  const bool names_axis =
      from->kind() == ConfigNode::Kind::kScalar &&
      std::any_of(study.axes.begin(), study.axes.end(),
                  [&](const StudyAxis& axis) { return axis.name == from->text(); });
  if (names_axis && !map.find("to")) return true;
  return std::all_of(map.entries().begin(), map.entries().end(), [](const ConfigNode::Entry& e) {
    return e.first == "from" || e.first == "times" || e.first == "power";
  });
}

/// `value` with every {from: AXIS, times: A, power: P} in it replaced by its number.
ConfigNode resolved(const ConfigNode& value, const Study& study,
                    const std::vector<AxisOption>& place) {
  if (value.kind() == ConfigNode::Kind::kList) {
    ConfigNode out = ConfigNode::list(value.where());
    for (const ConfigNode& item : value.items()) out.append(resolved(item, study, place));
    return out;
  }
  if (value.kind() != ConfigNode::Kind::kMap) return value;
  if (!isExpression(value, study)) {
    ConfigNode out = ConfigNode::map(value.where());
    for (const auto& [key, child] : value.entries()) out.set(key, resolved(child, study, place));
    return out;
  }
  ConfigReader in(value, "from");
  const AxisOption& option = place[study.axisIndex(in.text("from"))];
  const double factor = in.numberOr("times", 1), power = in.numberOr("power", 1);
  in.finish();
  if (!option.number) {
    throw InputError(fmt::format("{}: axis '{}' is at '{}', which is no number to compute from",
                                 toText(value.where()), value.find("from")->text(), option.label));
  }
  return ConfigNode::scalar(numberText(factor * std::pow(*option.number, power)), false,
                            value.where());
}

std::string caseId(const StudyCase& c) {
  Digest digest;
  for (const std::string& text : c.overrides) digest.add(text + "\n");
  digest.add(fmt::format("seed={}\n", c.seed));
  return digest.hex().substr(0, 16);
}

bool excluded(const Study& study, const std::vector<AxisOption>& place) {
  return std::any_of(study.exclusions.begin(), study.exclusions.end(), [&](const Exclusion& e) {
    return std::all_of(e.labels.begin(), e.labels.end(), [&](const auto& entry) {
      const std::string& label = place[study.axisIndex(entry.first)].label;
      return std::find(entry.second.begin(), entry.second.end(), label) != entry.second.end();
    });
  });
}

double inRange(const AxisRange& range, double share) {
  const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, share)
                                         : range.low + share * (range.high - range.low);
  return range.whole ? std::round(value) : value;
}

std::vector<std::vector<AxisOption>> sampledPlaces(const Study& study) {
  const auto shares =
      latinHypercube(study.samples, static_cast<int>(study.axes.size()), study.design_seed);
  std::vector<std::vector<AxisOption>> places;
  for (const std::vector<double>& share : shares) {
    std::vector<AxisOption> place;
    for (std::size_t a = 0; a < study.axes.size(); ++a) {
      const StudyAxis& axis = study.axes[a];
      // An axis with options is cut into equal parts, one for each.
      place.push_back(axis.range ? optionAt(axis, inRange(*axis.range, share[a]))
                                 : axis.options[static_cast<std::size_t>(
                                       share[a] * static_cast<double>(axis.options.size()))]);
    }
    places.push_back(std::move(place));
  }
  return places;
}

}  // namespace

std::string StudyCase::describe(const Study& study) const {
  std::vector<std::string> parts;
  for (std::size_t a = 0; a < point.size(); ++a) {
    const StudyAxis& axis = study.axes[a];
    parts.push_back(fmt::format("{} {}{}{}", axis.name, point[a].label,
                                axis.unit.empty() ? "" : " ", axis.unit));
  }
  parts.push_back(fmt::format("seed {}", seed));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::string> StudyCase::command(const std::string& scenario_path) const {
  std::vector<std::string> words = {"ballbot",      "run",    scenario_path,
                                    "--in-process", "--seed", std::to_string(seed)};
  for (const std::string& text : overrides) {
    words.push_back("--set");
    words.push_back(text);
  }
  return words;
}

std::vector<StudyCase> casesAt(const Study& study, const std::vector<AxisOption>& place) {
  StudyCase c;
  const auto apply = [&](const std::vector<Setting>& settings) {
    for (const auto& [path, value] : settings) {
      c.overrides.push_back(path + "=" + toFlowYaml(resolved(value, study, place)));
    }
  };
  apply(study.base);
  for (const AxisOption& option : place) {
    apply(option.settings);
    c.point.push_back(
        {option.label, option.number.value_or(std::numeric_limits<double>::quiet_NaN())});
  }
  std::vector<StudyCase> out;
  for (const std::uint64_t seed : study.seeds) {
    c.seed = seed;
    c.id = caseId(c);
    out.push_back(c);
  }
  return out;
}

std::vector<std::vector<AxisOption>> gridPlaces(const Study& study) {
  std::vector<std::vector<AxisOption>> places = {{}};
  for (const StudyAxis& axis : study.axes) {
    const std::vector<AxisOption> options =
        axis.options.empty() ? std::vector<AxisOption>(1) : axis.options;
    std::vector<std::vector<AxisOption>> longer;
    for (const auto& place : places) {
      for (const AxisOption& option : options) {
        longer.push_back(place);
        longer.back().push_back(option);
      }
    }
    places = std::move(longer);
  }
  places.erase(std::remove_if(places.begin(), places.end(),
                              [&](const auto& p) { return excluded(study, p); }),
               places.end());
  return places;
}

std::vector<StudyCase> generateCases(const Study& study) {
  const auto places = study.design == StudyDesign::kGrid ? gridPlaces(study) : sampledPlaces(study);
  std::vector<StudyCase> cases;
  std::map<std::string, std::string> seen;
  for (const auto& place : places) {
    for (StudyCase& c : casesAt(study, place)) {
      const auto [it, added] = seen.emplace(c.id, c.describe(study));
      if (!added) {
        throw InputError(fmt::format("{}: two cases are the same run: '{}' and '{}'",
                                     toText(study.tree.where()), it->second, c.describe(study)));
      }
      cases.push_back(std::move(c));
    }
  }
  if (cases.empty())
    throw InputError(fmt::format("{}: every case is excluded", toText(study.tree.where())));
  return cases;
}

std::vector<std::vector<double>> latinHypercube(int samples, int dimensions, std::uint64_t seed) {
  const RandomStream random(seed, "latin_hypercube");
  std::vector<std::vector<double>> out(static_cast<std::size_t>(samples),
                                       std::vector<double>(dimensions));
  for (int d = 0; d < dimensions; ++d) {
    std::vector<int> slice(samples);
    std::iota(slice.begin(), slice.end(), 0);
    for (int i = samples - 1; i >= 0; --i) {  // Fisher-Yates
      const auto draw =
          random.uniforms(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(d));
      std::swap(slice[i], slice[static_cast<int>(draw[0] * (i + 1))]);
      out[i][d] = draw[1];  // place within the slice
    }
    for (int i = 0; i < samples; ++i) out[i][d] = (slice[i] + out[i][d]) / samples;
  }
  return out;
}

}  // namespace ballbot
