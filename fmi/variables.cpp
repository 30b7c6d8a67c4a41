#include "fmi/variables.hpp"

#include "core/config_node.hpp"
#include "fmi/plant_parameters.hpp"
#include "fmi/units.hpp"
#include "model/signal_table.hpp"
#include "plant/added_sensors.hpp"
#include "plant/added_truth.hpp"

namespace ballbot {
namespace {

template <typename Frame>
FmuVariable variableOf(const std::string& prefix, const Signal<Frame>& signal, VariableRole role) {
  FmuVariable v;
  v.name = prefix + signal.name;
  v.type = isWhole(signal.kind) ? VariableType::kInteger : VariableType::kReal;
  v.role = role;
  v.continuous = signal.kind == SignalKind::kReal;
  v.unit = unitName(signal.unit, v.type == VariableType::kReal);
  v.description = signal.description;
  v.size = signal.size;
  return v;
}

FmuVariable variableOf(const std::string& prefix, const AddedSignal& s, VariableRole role) {
  FmuVariable v;
  v.name = prefix + s.name;
  v.role = role;
  v.unit = unitName(s.unit, true);
  v.description = s.words;
  return v;
}

}  // namespace

FmuVariables::FmuVariables(const ConfigNode& scenario) {
  FmuVariable time;
  time.name = "time";
  time.role = VariableRole::kTime;
  time.continuous = true;
  time.unit = "s";
  time.description = "simulated time";
  groups_.time = add(time);

  groups_.command = static_cast<ValueReference>(owner_.size());
  for (const auto& s : commandSignals()) add(variableOf("command.", s, VariableRole::kInput));
  groups_.forces = static_cast<ValueReference>(owner_.size());
  for (const auto& s : externalForceSignals()) add(variableOf("force.", s, VariableRole::kInput));
  groups_.sensors = static_cast<ValueReference>(owner_.size());
  for (const auto& s : sensorSignals()) add(variableOf("sensors.", s, VariableRole::kOutput));
  groups_.added_sensors = static_cast<ValueReference>(owner_.size());
  for (const AddedSignal& s : addedSensorsOf(scenario).signals().list) {
    add(variableOf("sensors.", s, VariableRole::kOutput));
  }
  groups_.truth = static_cast<ValueReference>(owner_.size());
  for (const auto& s : truthSignals()) add(variableOf("truth.", s, VariableRole::kLocal));
  groups_.added_truth = static_cast<ValueReference>(owner_.size());
  for (const AddedSignal& s : AddedTruth::list())
    add(variableOf("truth.", s, VariableRole::kLocal));

  FmuVariable digest;
  digest.name = "state_digest";
  digest.type = VariableType::kInteger;
  digest.description =
      "hash of the plant's complete state, low and high 32 bits: equal in equal states";
  digest.size = 2;
  groups_.digest = add(digest);

  groups_.parameters = static_cast<ValueReference>(owner_.size());
  for (const PlantParameter& p : plantParameters()) {
    FmuVariable v;
    v.name = p.path;
    v.type = p.type;
    v.role = VariableRole::kParameter;
    v.unit = unitName(p.unit, p.type == VariableType::kReal);
    v.description = p.description;
    v.choices = p.choices;
    v.start = parameterValue(p, scenario);
    add(v);
  }
}

ValueReference FmuVariables::add(FmuVariable variable) {
  variable.reference = static_cast<ValueReference>(owner_.size());
  owner_.insert(owner_.end(), static_cast<std::size_t>(variable.size),
                static_cast<std::uint32_t>(all_.size()));
  all_.push_back(std::move(variable));
  return all_.back().reference;
}

std::vector<double> FmuVariables::startValues() const {
  std::vector<double> values(owner_.size(), 0.0);
  for (const FmuVariable& v : all_) {
    for (int i = 0; i < v.size; ++i) values[v.reference + static_cast<ValueReference>(i)] = v.start;
  }
  return values;
}

std::string elementName(const FmuVariable& variable, int element) {
  return variable.isArray() ? variable.name + "[" + std::to_string(element + 1) + "]"
                            : variable.name;
}

}  // namespace ballbot
