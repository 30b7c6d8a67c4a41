#include "fmi/coupling_plan.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/fmu_description.hpp"
#include "model/signal_table.hpp"

namespace ballbot {
namespace {

/// What this program's plant FMU calls the hash of its state.
constexpr const char* kDigestPort = "state_digest";

template <typename Frame>
void addPorts(std::vector<CouplingPort>& ports, const std::string& prefix,
              const std::vector<Signal<Frame>>& signals) {
  for (const auto& s : signals) {
    CouplingPort port;
    port.name = prefix + s.name;
    if (*s.unit != '\0') port.unit = fmuUnit(s.unit);
    port.size = static_cast<std::size_t>(s.size);
    CouplingNode::add(ports, std::move(port));
  }
}

/// Commands follow from sensors at once: the controller is part of every loop.
CouplingNode controllerNode() {
  CouplingNode node{kControllerName, {}, {}};
  addPorts(node.inputs, "sensors.", sensorSignals());
  addPorts(node.outputs, "command.", commandSignals());
  for (CouplingPort& output : node.outputs) {
    for (std::size_t i = 0; i < node.inputs.size(); ++i) output.depends_on.push_back(i);
  }
  return node;
}

CouplingNode recordNode() {
  CouplingNode node{kRecordName, {}, {}};
  addPorts(node.inputs, "truth.", truthSignals());
  return node;
}

CouplingNode nativePlantNode() {
  CouplingNode node{kPlantName, {}, {}};
  addPorts(node.inputs, "command.", commandSignals());
  addPorts(node.inputs, "force.", externalForceSignals());
  addPorts(node.outputs, "sensors.", sensorSignals());
  addPorts(node.outputs, "truth.", truthSignals());
  return node;
}

/// "door.hand[2]" is the port "hand[2]" of "door".
bool belongsTo(const std::string& end, const std::string& node) {
  return end.rfind(node + ".", 0) == 0;
}
std::string portOf(const std::string& end) { return end.substr(end.find('.') + 1); }
std::string withoutElement(const std::string& end) { return end.substr(0, end.find('[')); }

FmuPort findFmuPort(const FmuDescription& fmu, const std::string& name,
                    const SourceLocation& where) {
  const FmuPort row = findPortOr(fmu, withoutElement(name));
  if (row.size > 0) return row;
  try {
    return findPort(fmu, name);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", toText(where), e.what()));
  }
}

CouplingPort makePort(const FmuDescription& fmu, const FmuPort& port) {
  CouplingPort out;
  out.name = port.name;
  out.size = static_cast<std::size_t>(port.size);
  const std::string& unit = port.first().unit;
  const auto it = std::find_if(fmu.units.begin(), fmu.units.end(),
                               [&](const FmuUnit& u) { return u.name == unit; });
  out.unit = it == fmu.units.end() ? FmuUnit{unit} : *it;
  return out;
}

/// The inputs, by their number, that an output depends on at once.
std::vector<std::size_t> dependencies(const FmuPort& output, const std::vector<FmuPort>& inputs) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool depends = std::any_of(
        output.variables.begin(), output.variables.end(), [&](const ImportedVariable& o) {
          return o.depends_on_all ||
                 std::any_of(inputs[i].variables.begin(), inputs[i].variables.end(),
                             [&](const ImportedVariable& v) {
                               return std::find(o.depends_on.begin(), o.depends_on.end(),
                                                v.reference) != o.depends_on.end();
                             });
        });
    if (depends) out.push_back(i);
  }
  return out;
}

void requireRole(const FmuPort& port, const CouplingLine& line, bool as_input) {
  const VariableRole role = port.first().role;
  const bool input = role == VariableRole::kInput;
  const bool readable =
      role == VariableRole::kOutput || role == VariableRole::kLocal || role == VariableRole::kTime;
  if (as_input ? input : readable) return;
  throw InputError(fmt::format(
      "{}: '{}' is no {}{}", toText(line.where), as_input ? line.to : line.from,
      as_input ? "input" : "output",
      role == VariableRole::kParameter ? ", but a parameter; set it under 'parameters'" : ""));
}

/// One FMU of the scenario, as far as connections use it.
struct UsedFmu {
  FmuEntry entry;
  FmuDescription description;
};

CouplingNode fmuNode(const UsedFmu& fmu, const std::vector<CouplingLine>& lines, FmuUse& use) {
  std::vector<FmuPort> inputs, outputs;
  const auto keep = [](std::vector<FmuPort>& ports, const FmuPort& port) {
    const bool known = std::any_of(ports.begin(), ports.end(),
                                   [&](const FmuPort& p) { return p.name == port.name; });
    if (!known) ports.push_back(port);
  };
  for (const CouplingLine& line : lines) {
    if (belongsTo(line.to, fmu.entry.name)) {
      const FmuPort port = findFmuPort(fmu.description, portOf(line.to), line.where);
      requireRole(port, line, true);
      keep(inputs, port);
    }
    if (belongsTo(line.from, fmu.entry.name)) {
      const FmuPort port = findFmuPort(fmu.description, portOf(line.from), line.where);
      requireRole(port, line, false);
      keep(outputs, port);
    }
  }
  CouplingNode node{fmu.entry.name, {}, {}};
  for (const FmuPort& port : inputs) {
    CouplingNode::add(node.inputs, makePort(fmu.description, port));
    use.inputs.push_back(port.name);
  }
  for (const FmuPort& port : outputs) {
    CouplingPort out = makePort(fmu.description, port);
    if (port.first().role != VariableRole::kTime) out.depends_on = dependencies(port, inputs);
    CouplingNode::add(node.outputs, std::move(out));
    use.outputs.push_back(port.name);
  }
  return node;
}

/// Lines that nobody had to write, from `from` to `to` for each signal whose plant has that name.
template <typename Frame>
void addLines(std::vector<CouplingLine>& lines, const std::vector<Signal<Frame>>& signals,
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
  for (const auto& [name, value] : fmu.entry.parameters) {
    FmuPort port = findPortOr(d, name);
    if (port.size == 0) port = findFmuPort(d, name, fmu.entry.where);
    if (port.first().role != VariableRole::kParameter || port.size != 1) {
      throw InputError(fmt::format("{}: '{}' is no parameter with one value", at, name));
    }
  }
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
      throw InputError(
          fmt::format("fmus: only some elements of '{}.{}' are connected", node.name, input.name));
    }
  }
}

}  // namespace

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
  CouplingPlan plan{CouplingGraph(std::move(nodes), lines), std::move(uses), !plant_fmu, true};
  if (plant_fmu) requireSensors(plan.graph, plant_fmu->entry.where);
  requireWholeInputs(plan.graph);
  const std::size_t record = plan.graph.find(kRecordName);
  for (const CouplingPort& input : plan.graph.nodes()[record].inputs) {
    plan.has_truth = plan.has_truth && plan.graph.fed(record, input);
  }
  return plan;
}

}  // namespace ballbot
