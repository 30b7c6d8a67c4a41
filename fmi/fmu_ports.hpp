#pragma once

#include <string>
#include <vector>

#include "fmi/fmu_description.hpp"

namespace ballbot {

/// One or more variables under one name, as one row of numbers: an FMI 3 array, a scalar, or a row
/// of scalars.
struct FmuPort {
  std::string name;
  std::vector<std::string> aliases;
  std::vector<ImportedVariable> variables;
  int size = 0;
  std::vector<std::size_t> dimensions;  ///< of an array or a row; empty for a scalar
  std::size_t first_index = 1;          ///< number of the first element
  const ImportedVariable& first() const { return variables.front(); }
};

/// What has exactly this name or alias: a variable, else a row of scalars.
/// @throw InputError if there is neither, naming a near one, or its size is not fixed.
FmuPort findPort(const FmuDescription& fmu, const std::string& name);
/// The same, or an empty port.
FmuPort findPortOr(const FmuDescription& fmu, const std::string& name);

/// The port that a connection's end belongs to, which may be one element of it: "hand" for
/// "hand[2]". A variable of exactly that name comes first, as an element of its row if it has one.
/// @throw InputError as findPort().
FmuPort findPortOf(const FmuDescription& fmu, const std::string& end);

/// All variables as connections name them, in the order of the model description.
std::vector<FmuPort> allPorts(const FmuDescription& fmu);

}  // namespace ballbot
