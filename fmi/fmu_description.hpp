#pragma once

#include <string>
#include <vector>

#include "fmi/units.hpp"
#include "fmi/variables.hpp"

namespace ballbot {

/// A variable of somebody's FMU, as its model description has it.
struct ImportedVariable {
  std::string name;
  std::string type;  ///< "Real", "Float64", "Int32", ...: the element or attribute that says so
  VariableRole role = VariableRole::kLocal;
  ValueReference reference = 0;
  int size = 1;
  std::string unit;  ///< empty where none is given
  std::string description, start;
  /// Outputs only: the inputs it depends on within one time, or that nothing is said, which means
  /// all of them.
  bool depends_on_all = true;
  std::vector<ValueReference> depends_on;
};

/// What the model description of an FMU for Co-Simulation says.
struct FmuDescription {
  std::string file;
  int fmi_version = 0;  ///< 2 or 3
  std::string model_name, description, generation_tool, token, model_identifier;
  bool saves_state = false;     ///< can get, set and serialize its state
  bool variable_steps = false;  ///< takes steps of any size
  bool needs_execution_tool = false;
  std::vector<FmuUnit> units;
  std::vector<ImportedVariable> variables;
  bool has_binary = false;  ///< a shared object for this kind of machine

  const ImportedVariable* find(const std::string& name) const;
  /// Path of the shared object inside the FMU.
  std::string binaryPath() const;
};

/// Reads it from an FMU file.
/// @throw InputError if the file is no FMU for Co-Simulation of FMI 2 or 3, saying what it is.
FmuDescription readFmuDescription(const std::string& path);

/// One or more variables under one name, as one row of numbers: an FMI 3 array, a scalar, or the
/// scalars name[1], name[2], ... of FMI 2.
struct FmuPort {
  std::string name;
  std::vector<ImportedVariable> variables;
  int size = 0;
  const ImportedVariable& first() const { return variables.front(); }
};

/// @throw InputError if there is no such variable, naming a near one.
FmuPort findPort(const FmuDescription& fmu, const std::string& name);
/// The same, or an empty port.
FmuPort findPortOr(const FmuDescription& fmu, const std::string& name);

}  // namespace ballbot
