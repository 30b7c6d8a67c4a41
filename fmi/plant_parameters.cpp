#include "fmi/plant_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config_listing.hpp"
#include "core/config_values.hpp"
#include "core/error.hpp"
#include "model/robot_reader.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {
namespace {

/// Sections whose own plain keys are parameters. Others exist only where a scenario has them, and
/// a parameter cannot make them.
const std::set<std::string> kSections = {"",
                                         "robot.actuators.wheel",
                                         "robot.actuators.arm",
                                         "robot.sensors.imu",
                                         "robot.sensors.encoders",
                                         "plant",
                                         "plant.fidelity",
                                         "initial",
                                         "environment"};

void describeParts(ConfigVisitor& v) {
  std::uint64_t seed = PlantConfig().seed;
  describeSeed(v, seed);
  v.section(must("plant", "the plant"), describePlant);
  v.section(must("initial", "the start"), describeInitial);
  v.section(must("environment", "around the robot"), describeEnvironment);
  v.section(must("robot", "the robot"), [](ConfigVisitor& robot) {
    robot.section(must("actuators", "its drives"),
                  [](ConfigVisitor& in) { RobotActuators().describe(in); });
    robot.section(must("sensors", "its sensors"), describeSensors);
  });
}

std::string sectionOf(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

/// Drives of wheels and arm have the same words.
std::string whose(const std::string& section) {
  if (section == "robot.actuators.wheel") return "wheels: ";
  if (section == "robot.actuators.arm") return "arm joints: ";
  return "";
}

std::optional<PlantParameter> parameterOf(const KeyEntry& key) {
  const std::string section = sectionOf(key.path);
  if (kSections.count(section) == 0) return std::nullopt;
  PlantParameter p;
  p.path = key.path;
  p.unit = key.unit;
  p.description = whose(section) + key.words;
  const std::string& fallback = key.fallback;
  switch (key.kind) {
    case KeyKind::kNumber:
    case KeyKind::kInteger:
      p.type = key.kind == KeyKind::kNumber ? VariableType::kReal : VariableType::kInteger;
      if (!fallback.empty()) p.fallback = std::stod(fallback);
      return p;
    case KeyKind::kDuration:
      // Periods decide when the plant can be stepped to; they are the scenario's.
      if (section != "initial") return std::nullopt;
      p.fallback = std::stod(fallback);
      return p;
    case KeyKind::kBoolean:
      p.type = VariableType::kBoolean;
      p.fallback = fallback == "true" ? 1 : 0;
      return p;
    case KeyKind::kChoice: {
      p.type = VariableType::kEnumeration;
      p.choices = key.choices;
      const auto at = std::find(p.choices.begin(), p.choices.end(), fallback);
      p.fallback = static_cast<double>(at - p.choices.begin()) + 1;
      return p;
    }
    default:
      return std::nullopt;
  }
}

std::vector<PlantParameter> makeParameters() {
  ConfigListing listing;
  describeParts(listing);
  std::vector<PlantParameter> out;
  for (const KeyEntry& key : listing.take()) {
    if (auto parameter = parameterOf(key)) out.push_back(std::move(*parameter));
  }
  for (PlantParameter& p : out) {
    if (p.path == "environment.payload_kg") p.otherwise = "robot.payload_mass_kg";
  }
  return out;
}

/// The mapping that should hold the last part of a dotted path.
struct Place {
  const ConfigNode* parent = nullptr;
  std::string path, key;
  bool found() const { return parent && parent->find(key); }
};

Place find(const ConfigNode& root, const std::string& dotted) {
  Place place{&root, "", dotted};
  const std::size_t last = dotted.rfind('.');
  if (last == std::string::npos) return place;
  place.path = dotted.substr(0, last);
  place.key = dotted.substr(last + 1);
  for (std::size_t begin = 0; place.parent && begin <= last;) {
    const std::size_t dot = std::min(dotted.find('.', begin), last);
    place.parent = place.parent->find(dotted.substr(begin, dot - begin));
    begin = dot + 1;
  }
  return place;
}

}  // namespace

const std::vector<PlantParameter>& plantParameters() {
  static const std::vector<PlantParameter> parameters = makeParameters();
  return parameters;
}

double parameterValue(const PlantParameter& p, const ConfigNode& scenario) {
  Place place = find(scenario, p.path);
  if (!place.found() && !p.otherwise.empty()) place = find(scenario, p.otherwise);
  if (!place.found()) return p.fallback;
  const std::string& key = place.key;
  ConfigReader in(*place.parent, place.path);
  switch (p.type) {
    case VariableType::kBoolean:
      return in.boolean(key) ? 1 : 0;
    case VariableType::kEnumeration: {
      const std::string text = in.text(key);
      const auto it = std::find(p.choices.begin(), p.choices.end(), text);
      if (it == p.choices.end()) {
        throw InputError(fmt::format("{} is '{}', must be one of: {}", in.at(key), text,
                                     fmt::join(p.choices, ", ")));
      }
      return static_cast<double>(it - p.choices.begin()) + 1;
    }
    default:
      return in.number(key);
  }
}

void setParameter(const PlantParameter& p, double value, ConfigNode& scenario) {
  std::string text;
  switch (p.type) {
    case VariableType::kReal:
      text = fmt::format("{}", value);
      break;
    case VariableType::kBoolean:
      text = value != 0 ? "true" : "false";
      break;
    case VariableType::kInteger:
      text = fmt::format("{}", static_cast<std::int64_t>(value));
      break;
    case VariableType::kEnumeration:
      if (!(value >= 1 && value <= static_cast<double>(p.choices.size()))) {
        throw InputError(fmt::format("{} is {}, must be 1 to {}: {}", p.path, value,
                                     p.choices.size(), fmt::join(p.choices, ", ")));
      }
      text = p.choices[static_cast<std::size_t>(value) - 1];
      break;
  }
  setPath(scenario, p.path, ConfigNode::scalar(text, false, {"parameter " + p.path, 0, 0}));
}

}  // namespace ballbot
