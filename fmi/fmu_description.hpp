#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "fmi/fmu_types.hpp"
#include "fmi/units.hpp"
#include "fmi/variables.hpp"

namespace ballbot {

/// A variable of somebody's FMU, as its model description has it.
struct ImportedVariable {
  std::string name;
  std::vector<std::string> aliases;  ///< other names of the same variable (FMI 3)
  std::string type;  ///< "Real", "Float64", "Int32", ...: the element or attribute that says so
  const FmuType* facts = nullptr;  ///< of that type; never null once read
  VariableRole role = VariableRole::kLocal;
  ValueReference reference = 0;
  std::vector<std::size_t> dimensions;  ///< of an array (FMI 3)
  int size = 1;                         ///< 0: not fixed, or beyond what can be connected
  std::string unit;                     ///< empty where none is given
  std::string description, start;
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  /// Of an enumeration whose type says them, in order: the numbers of its items.
  std::shared_ptr<const std::vector<double>> items;
  /// Outputs only: the inputs it depends on within one time, or that nothing is said, which means
  /// all of them.
  bool depends_on_all = true;
  std::vector<ValueReference> depends_on;
};

/// Why `value` cannot be given to the variable without loss, e.g. "must be a whole number between
/// -128 and 127"; empty if it can. Whatever is no number is the FMU's own business where it takes
/// reals.
std::string refusalOf(const ImportedVariable& variable, double value);

/// The scalars name[1], name[2], ..., or name[0], name[1], ..., of one causality, type and unit.
struct VariableRow {
  std::size_t first_index = 1;
  std::vector<std::size_t> variables;  ///< their places in FmuDescription::variables
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

  std::unordered_map<std::string, std::size_t> by_name;  ///< variables, by names and aliases
  /// Rows of scalars, by their common name, which is no variable's own.
  std::unordered_map<std::string, VariableRow> rows;

  /// By name or alias; null if there is none.
  const ImportedVariable* find(const std::string& name) const;
  /// The name of the row that a variable is an element of; empty if of none.
  std::string rowOf(const ImportedVariable& variable) const;
  /// Path of the shared object inside the FMU.
  std::string binaryPath() const;
};

/// Reads it from an FMU file.
/// @throw InputError if the file is no FMU for Co-Simulation of FMI 2 or 3, saying what it is, or
///        if its model description is too large to be one.
FmuDescription readFmuDescription(const std::string& path);

}  // namespace ballbot
