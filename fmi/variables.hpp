#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ballbot {

class ConfigNode;

/// Value reference of an FMU variable. An array's elements are numbered through: in FMI 2, which
/// knows scalars only, each has its own; in FMI 3 the array answers to that of its first element.
using ValueReference = std::uint32_t;

enum class VariableType { kReal, kInteger, kBoolean, kEnumeration };
enum class VariableRole { kTime, kInput, kOutput, kLocal, kParameter };

/// One variable of the plant FMU, as the model description shows it and the instance serves it.
struct FmuVariable {
  std::string name;  ///< "sensors.motor_angle"; parameters have their path in the scenario
  VariableType type = VariableType::kReal;
  VariableRole role = VariableRole::kLocal;
  bool continuous = false;  ///< else it changes at certain times only
  std::string unit;         ///< key of fmi/units.hpp; empty where there is none
  std::string description;
  int size = 1;
  ValueReference reference = 0;  ///< of the first element
  double start = 0;              ///< of inputs (all elements) and parameters; enumerations from 1
  std::vector<std::string> choices;  ///< of an enumeration, as the scenario writes them

  bool isArray() const { return size > 1; }
  bool hasStart() const { return role == VariableRole::kInput || role == VariableRole::kParameter; }
};

/// All variables of the plant FMU. Their order, names and references are the same for every
/// scenario with the same added sensors; the start values of parameters come from it.
class FmuVariables {
 public:
  /// @param scenario with includes resolved. @throw InputError for bad values of parameters.
  explicit FmuVariables(const ConfigNode& scenario);

  const std::vector<FmuVariable>& all() const { return all_; }
  /// The variable an element belongs to; null where there is no such reference.
  const FmuVariable* find(ValueReference reference) const {
    return reference < owner_.size() ? &all_[owner_[reference]] : nullptr;
  }
  /// First element of each group of variables, in which the rows follow one another.
  struct Groups {
    ValueReference time, command, forces, sensors, added_sensors, truth, added_truth, digest,
        parameters;
  };
  const Groups& groups() const { return groups_; }
  /// Values of all elements before anything was set.
  std::vector<double> startValues() const;

 private:
  ValueReference add(FmuVariable variable);

  std::vector<FmuVariable> all_;
  std::vector<std::uint32_t> owner_;
  Groups groups_{};
};

/// "sensors.motor_angle[3]" for an element of an array, else the name.
std::string elementName(const FmuVariable& variable, int element);

}  // namespace ballbot
