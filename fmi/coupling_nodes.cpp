#include "fmi/coupling_nodes.hpp"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/fmu_ports.hpp"
#include "model/signal_table.hpp"
#include "plant/added_truth.hpp"

namespace ballbot {
namespace {

template <typename Frame>
void describePort(const Signal<Frame>& s, CouplingPort& port) {
  const std::string unit = unitName(s.unit, !isWhole(s.kind));
  if (!unit.empty()) port.unit = fmuUnit(unit);
  if (isWhole(s.kind)) port.kind = ValueKind::kInteger;
  port.size = static_cast<std::size_t>(s.size);
}

void describePort(const AddedSignal& s, CouplingPort& port) {
  const std::string unit = unitName(s.unit, true);
  if (!unit.empty()) port.unit = fmuUnit(unit);
  port.size = 1;
}

template <typename AnySignal>
void addPorts(std::vector<CouplingPort>& ports, const std::string& prefix,
              const std::vector<AnySignal>& signals) {
  for (const auto& s : signals) {
    CouplingPort port;
    port.name = prefix + s.name;
    describePort(s, port);
    CouplingNode::add(ports, std::move(port));
  }
}

FmuPort findFmuPort(const FmuDescription& fmu, const std::string& end,
                    const SourceLocation& where) {
  try {
    return findPortOf(fmu, end);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", toText(where), e.what()));
  }
}

CouplingPort makePort(const FmuDescription& fmu, const FmuPort& port) {
  CouplingPort out;
  out.name = port.name;
  out.aliases = port.aliases;
  out.kind = port.first().facts->kind;
  out.size = static_cast<std::size_t>(port.size);
  out.dimensions = port.dimensions;
  out.first_index = port.first_index;
  const std::string& unit = port.first().unit;
  const auto it = std::find_if(fmu.units.begin(), fmu.units.end(),
                               [&](const FmuUnit& u) { return u.name == unit; });
  out.unit = it == fmu.units.end() ? FmuUnit{unit} : *it;
  return out;
}

/// The inputs, by their number, that an output depends on at once.
std::vector<std::size_t> dependencies(const FmuPort& output, const std::vector<FmuPort>& inputs) {
  std::unordered_set<ValueReference> on;
  bool on_all = false;
  for (const ImportedVariable& o : output.variables) {
    on_all = on_all || o.depends_on_all;
    on.insert(o.depends_on.begin(), o.depends_on.end());
  }
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool depends =
        on_all ||
        std::any_of(inputs[i].variables.begin(), inputs[i].variables.end(),
                    [&](const ImportedVariable& v) { return on.count(v.reference) != 0; });
    if (depends) out.push_back(i);
  }
  return out;
}

void requireConnectable(const FmuPort& port, const CouplingLine& line, bool as_input) {
  const std::string& end = as_input ? line.to : line.from;
  const VariableRole role = port.first().role;
  const bool input = role == VariableRole::kInput;
  const bool readable =
      role == VariableRole::kOutput || role == VariableRole::kLocal || role == VariableRole::kTime;
  if (!(as_input ? input : readable)) {
    throw InputError(fmt::format(
        "{}: '{}' is no {}{}", toText(line.where), end, as_input ? "input" : "output",
        role == VariableRole::kParameter ? ", but a parameter; set it under 'parameters'" : ""));
  }
  if (port.first().facts->kind == ValueKind::kOther) {
    throw InputError(
        fmt::format("{}: '{}' is of type {}; numbers, booleans and enumerations can be connected",
                    toText(line.where), end, port.first().type));
  }
}

}  // namespace

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
  addPorts(node.inputs, "truth.", AddedTruth::list());
  return node;
}

CouplingNode nativePlantNode() {
  CouplingNode node{kPlantName, {}, {}};
  addPorts(node.inputs, "command.", commandSignals());
  addPorts(node.inputs, "force.", externalForceSignals());
  addPorts(node.outputs, "sensors.", sensorSignals());
  addPorts(node.outputs, "truth.", truthSignals());
  addPorts(node.outputs, "truth.", AddedTruth::list());
  return node;
}

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
      requireConnectable(port, line, true);
      keep(inputs, port);
    }
    if (belongsTo(line.from, fmu.entry.name)) {
      const FmuPort port = findFmuPort(fmu.description, portOf(line.from), line.where);
      requireConnectable(port, line, false);
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

bool belongsTo(const std::string& end, const std::string& node) {
  return end.rfind(node + ".", 0) == 0;
}

std::string portOf(const std::string& end) { return end.substr(end.find('.') + 1); }

}  // namespace ballbot
