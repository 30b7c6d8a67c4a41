#include "fmi/plant_contents.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "fmi/plant_fmu.hpp"
#include "fmi/plant_parameters.hpp"
#include "fmi/zip_archive.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {
namespace {

constexpr std::uint64_t kLongestResource = std::uint64_t{64} << 20;

/// What an FMU of this program was made from.
struct Contents {
  ConfigNode tree = ConfigNode::map({});
  std::string urdf;
};

/// Nothing for an FMU of others: its resources, if it has any, are not what its token says.
std::optional<Contents> contentsOf(const FmuDescription& fmu) {
  const char* const scenario = "resources/scenario.yaml";
  const char* const robot = "resources/robot.urdf";
  if (!zipHas(fmu.file, scenario) || !zipHas(fmu.file, robot)) return std::nullopt;
  const std::string yaml = readFromZip(fmu.file, scenario, kLongestResource);
  const std::string urdf = readFromZip(fmu.file, robot, kLongestResource);
  if (fmu.token != fmuToken(yaml, urdf, fmu.fmi_version)) return std::nullopt;
  return Contents{parseYaml(yaml, fmu.file + ": " + scenario), urdf};
}

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The plant's sections, with every parameter spelt out in one form: what is left to a default
/// equals what says the same.
ConfigNode plantSections(const ConfigNode& scenario) {
  ConfigNode out = ConfigNode::map(scenario.where());
  for (const char* section : kPlantSections) {
    if (const ConfigNode* node = scenario.find(section)) out.set(section, *node);
  }
  for (const PlantParameter& p : plantParameters()) setParameter(p, parameterValue(p, out), out);
  if (ConfigNode* robot = out.find("robot")) robot->erase("urdf");
  return out;
}

bool isEmpty(const ConfigNode* node) {
  return !node || (node->text().empty() && node->entries().empty() && node->items().empty());
}

bool sameText(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const auto number = [](const std::string& text) -> std::optional<double> {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stopped == end ? std::optional<double>(value) : std::nullopt;
  };
  const auto x = number(a), y = number(b);
  return x && y && *x == *y;
}

std::string describe(const ConfigNode* node) {
  if (isEmpty(node)) return "nothing";
  return node->kind() == ConfigNode::Kind::kScalar ? node->text() : node->kindName();
}

/// "environment.pushes is a list here, nothing in the FMU" for the first difference; empty if
/// there is none.
std::string difference(const std::string& path, const ConfigNode* here, const ConfigNode* there) {
  if (isEmpty(here) && isEmpty(there)) return "";
  const bool alike = !isEmpty(here) && !isEmpty(there) && here->kind() == there->kind() &&
                     here->items().size() == there->items().size() &&
                     sameText(here->text(), there->text());
  if (!alike) {
    return fmt::format("{} is {} in the scenario{}, {} in the FMU", path, describe(here),
                       here && here->where().line > 0 ? " (" + toText(here->where()) + ")" : "",
                       describe(there));
  }
  const std::string dot = path.empty() ? "" : path + ".";
  std::set<std::string> keys;
  for (const auto& [key, value] : here->entries()) keys.insert(key);
  for (const auto& [key, value] : there->entries()) keys.insert(key);
  for (const std::string& key : keys) {
    const std::string found = difference(dot + key, here->find(key), there->find(key));
    if (!found.empty()) return found;
  }
  for (std::size_t i = 0; i < here->items().size(); ++i) {
    const std::string found =
        difference(fmt::format("{}{}", dot, i), &here->items()[i], &there->items()[i]);
    if (!found.empty()) return found;
  }
  return "";
}

/// With the values that the entry sets before initialisation.
void apply(const std::map<std::string, double>& values, ConfigNode& tree) {
  for (const PlantParameter& p : plantParameters()) {
    const auto it = values.find(p.path);
    if (it != values.end()) setParameter(p, it->second, tree);
  }
}

/// What an FMU of others cannot be known to do.
void requireNothingElse(const ConfigNode& scenario, const FmuEntry& entry) {
  const ConfigNode* plant = scenario.find("plant");
  const std::pair<const char*, const ConfigNode*> others[] = {
      {"environment", scenario.find("environment")},
      {"plant.faults", plant ? plant->find("faults") : nullptr}};
  for (const auto& [name, node] : others) {
    if (isEmpty(node)) continue;
    throw InputError(fmt::format(
        "{}: the scenario has '{}' ({}), which '{}' in the plant's place would have to contain; "
        "nothing in it says so. Take it out of the scenario, or export the plant with 'ballbot "
        "fmu'",
        toText(entry.where), name, toText(node->where()), entry.file));
  }
}

}  // namespace

void requireSamePlant(const ConfigNode& scenario, const FmuEntry& entry,
                      const FmuDescription& description) {
  std::optional<Contents> contents = contentsOf(description);
  if (!contents) return requireNothingElse(scenario, entry);
  apply(entry.parameters, contents->tree);
  const ConfigNode here = plantSections(scenario), there = plantSections(contents->tree);
  std::string found = difference("", &here, &there);
  const ConfigNode* robot = scenario.find("robot");
  const ConfigNode* urdf = robot ? robot->find("urdf") : nullptr;
  if (found.empty() && urdf && bytesOf(urdfPath(*urdf)) != contents->urdf) {
    found = fmt::format("robot.urdf '{}' is another file than the one in the FMU", urdf->text());
  }
  if (found.empty()) return;
  throw InputError(fmt::format(
      "{}: '{}' is not the plant of this scenario: {}. Export it from this scenario (ballbot fmu "
      "--fmi {} --scenario ... -o ...), or give the scenario what the FMU has; parameters under "
      "'fmus' count as the FMU's",
      toText(entry.where), entry.file, found, description.fmi_version));
}

}  // namespace ballbot
