#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// A unit as FMI defines one: factor times a product of SI base units. Some of our noise figures
/// are per root of a unit, which FMI cannot say; they have a name only.
struct FmuUnit {
  std::string name;
  bool has_base = false;
  double factor = 1;
  int kg = 0, m = 0, s = 0, rad = 0, K = 0;
};

const std::vector<FmuUnit>& fmuUnits();

/// Whether two units are the same quantity on the same scale, e.g. "N.m" and "kg.m2/s2" by their
/// base units, or equal names where one has none.
bool sameUnit(const FmuUnit& a, const FmuUnit& b);

/// The name of the unit of one of our own variables: a real that has none is a plain number, unit
/// "1", so that importers can tell "none" from "forgotten"; counts and choices have no unit.
std::string unitName(const std::string& unit, bool real);

/// The unit of that name. @throw Error if there is none: every unit of a variable is defined.
const FmuUnit& fmuUnit(const std::string& name);

}  // namespace ballbot
