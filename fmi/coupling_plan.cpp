#include "fmi/coupling_plan.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/coupling_nodes.hpp"
#include "fmi/fmu_ports.hpp"
#include "fmi/plant_contents.hpp"
#include "model/signal_table.hpp"
#include "plant/added_truth.hpp"

namespace ballbot {
namespace {

/// What this program's plant FMU calls the hash of its state.
constexpr const char* kDigestPort = "state_digest";

std::string withoutElement(const std::string& end) { return end.substr(0, end.find('[')); }

/// Lines that nobody had to write, from `from` to `to` for each signal whose plant has that name.
template <typename AnySignal>
void addLines(std::vector<CouplingLine>& lines, const std::vector<AnySignal>& signals,
              const std::string& from, const std::string& to, const UsedFmu* plant) {
  for (const auto& s : signals) {
    CouplingLine line{from + s.name, to + s.name, false, {}};
    const bool written = std::any_of(lines.begin(), lines.end(), [&](const CouplingLine& other) {
      return withoutElement(other.to) == line.to;
    });
    const std::string& of_plant = belongsTo(line.from, kPlantName) ? line.from : line.to;
    if (written || (plant && findPortOr(plant->description, portOf(of_plant)).size == 0)) continue;
    if (plant) line.where = plant->entry.where;
    lines.push_back(std::move(line));
  }
}

/// A parameter that is there, and takes this value as it is.
void requireSettable(const UsedFmu& fmu, const std::string& name, double value) {
  const std::string at = toText(fmu.entry.where) + ": ";
  FmuPort port;
  try {
    port = findPort(fmu.description, name);
  } catch (const InputError& e) {
    throw InputError(at + e.what());
  }
  const ImportedVariable& v = port.first();
  if (v.role != VariableRole::kParameter || port.size != 1) {
    throw InputError(
        fmt::format("{}{}: '{}' is no parameter with one value", at, fmu.description.file, name));
  }
  if (v.facts->kind == ValueKind::kOther) {
    throw InputError(fmt::format("{}{}: parameter '{}' is of type {}, which cannot be set", at,
                                 fmu.description.file, name, v.type));
  }
  std::string refusal = refusalOf(v, value);
  if (refusal.empty() && !(value >= v.minimum && value <= v.maximum)) {
    refusal = fmt::format("must be between {} and {}", v.minimum, v.maximum);
  }
  if (refusal.empty()) return;
  throw InputError(fmt::format("{}{}: parameter '{}' is {}, {}", at, fmu.description.file, name,
                               value, refusal));
}

void requireUsable(const UsedFmu& fmu) {
  const FmuDescription& d = fmu.description;
  const std::string at = toText(fmu.entry.where) + ": " + d.file;
  if (d.needs_execution_tool) {
    throw InputError(at + ": needs the tool that made it, to run; export it without that need");
  }
  if (!d.has_binary) {
    throw InputError(
        fmt::format("{}: has no {}, only code for other machines", at, d.binaryPath()));
  }
  for (const auto& [name, value] : fmu.entry.parameters) requireSettable(fmu, name, value);
}

/// Sensors that the controller needs; an outside pose may be missing.
void requireSensors(const CouplingGraph& graph, const SourceLocation& where) {
  const std::size_t controller = graph.find(kControllerName);
  for (const CouplingPort& input : graph.nodes()[controller].inputs) {
    if (graph.fed(controller, input) || input.name.rfind("sensors.pose_", 0) == 0) continue;
    throw InputError(fmt::format(
        "{}: the plant's FMU has no '{}', and no connection brings it. Add one, e.g. {{from: "
        "plant.its_name_for_it, to: controller.{}}}",
        toText(where), input.name, input.name));
  }
  const CouplingPort& torque = graph.nodes()[controller].outputs.front();
  if (!graph.used(controller, torque)) {
    throw InputError(
        fmt::format("{}: the plant's FMU takes no '{}', and no connection brings it "
                    "anywhere. Add one, e.g. {{from: controller.{}, to: "
                    "plant.its_name_for_it}}",
                    toText(where), torque.name, torque.name));
  }
}

/// Every input of an FMU is connected as a whole: the other elements would be zero in silence.
void requireWholeInputs(const CouplingGraph& graph) {
  for (std::size_t n = 0; n < graph.nodes().size(); ++n) {
    const CouplingNode& node = graph.nodes()[n];
    if (node.name == kControllerName || node.name == kRecordName || node.name == kPlantName)
      continue;
    for (const CouplingPort& input : node.inputs) {
      if (graph.fed(n, input)) continue;
      throw InputError(fmt::format(
          "fmus: only some elements of '{}.{}' are connected; the others would be zero in "
          "silence. Connect them, too",
          node.name, input.name));
    }
  }
}

}  // namespace

bool CouplingPlan::feeds(const AddedSignals& truth) const {
  const std::vector<std::size_t> places = AddedTruth::placesOf(truth);
  return std::all_of(places.begin(), places.end(),
                     [&](std::size_t place) { return added_truth[place]; });
}

CouplingPlan planCoupling(const ConfigNode& scenario) {
  std::vector<UsedFmu> fmus;
  std::vector<CouplingLine> lines;
  for (FmuEntry& entry : readFmus(scenario)) {
    fmus.push_back({entry, readFmuDescription(entry.file)});
    requireUsable(fmus.back());
    lines.insert(lines.end(), entry.lines.begin(), entry.lines.end());
  }
  const auto plant = std::find_if(fmus.begin(), fmus.end(),
                                  [](const UsedFmu& f) { return f.entry.name == kPlantName; });
  const UsedFmu* plant_fmu = plant == fmus.end() ? nullptr : &*plant;
  addLines(lines, commandSignals(), "controller.command.", "plant.command.", plant_fmu);
  addLines(lines, sensorSignals(), "plant.sensors.", "controller.sensors.", plant_fmu);
  addLines(lines, truthSignals(), "plant.truth.", "record.truth.", plant_fmu);
  addLines(lines, AddedTruth::list(), "plant.truth.", "record.truth.", plant_fmu);

  std::vector<CouplingNode> nodes;
  std::vector<FmuUse> uses;
  if (!plant_fmu) nodes.push_back(nativePlantNode());
  for (const UsedFmu& fmu : fmus) {
    FmuUse use;
    use.name = fmu.entry.name;
    use.file = fmu.entry.file;
    use.parameters = fmu.entry.parameters;
    use.patience = fmu.entry.patience;
    use.saves_state = fmu.description.saves_state;
    use.variable_steps = fmu.description.variable_steps;
    nodes.push_back(fmuNode(fmu, lines, use));
    if (&fmu == plant_fmu && findPortOr(fmu.description, kDigestPort).size == 2) {
      use.digest = kDigestPort;
    }
    uses.push_back(std::move(use));
  }
  nodes.push_back(controllerNode());
  nodes.push_back(recordNode());
  CouplingPlan plan{CouplingGraph(std::move(nodes), lines), std::move(uses), !plant_fmu, true, {}};
  if (plant_fmu) {
    requireSensors(plan.graph, plant_fmu->entry.where);
    requireSamePlant(scenario, plant_fmu->entry, plant_fmu->description);
  }
  requireWholeInputs(plan.graph);
  const std::size_t record = plan.graph.find(kRecordName);
  for (const CouplingPort& input : plan.graph.nodes()[record].inputs) {
    const bool fed = plan.graph.fed(record, input);
    if (input.offset < rowSize(truthSignals())) {
      plan.has_truth = plan.has_truth && fed;
    } else {
      plan.added_truth.push_back(fed);
    }
  }
  return plan;
}

}  // namespace ballbot
