#include "fmi/units.hpp"

#include <algorithm>

#include "core/angle.hpp"
#include "core/error.hpp"

namespace ballbot {

const std::vector<FmuUnit>& fmuUnits() {
  //                                                   name, base, factor, kg, m, s, rad
  static const std::vector<FmuUnit> units = {{"1", true, 1, 0, 0, 0, 0},
                                             {"s", true, 1, 0, 0, 1, 0},
                                             {"m", true, 1, 0, 1, 0, 0},
                                             {"kg", true, 1, 1, 0, 0, 0},
                                             {"rad", true, 1, 0, 0, 0, 1},
                                             {"deg", true, kRadPerDeg, 0, 0, 0, 1},
                                             {"Hz", true, 1, 0, 0, -1, 0},
                                             {"m/s", true, 1, 0, 1, -1, 0},
                                             {"m/s^2", true, 1, 0, 1, -2, 0},
                                             {"rad/s", true, 1, 0, 0, -1, 1},
                                             {"N", true, 1, 1, 1, -2, 0},
                                             {"N m", true, 1, 1, 2, -2, 0},
                                             {"N m/rad", true, 1, 1, 2, -2, -1},
                                             {"N m s/rad", true, 1, 1, 2, -1, -1},
                                             {"kg m^2", true, 1, 1, 2, 0, 0},
                                             {"K", true, 1, 0, 0, 0, 0, 1},
                                             {"rad/s/sqrt(Hz)"},
                                             {"m/s^2/sqrt(Hz)"},
                                             {"rad/s/sqrt(s)"},
                                             {"m/s^2/sqrt(s)"}};
  return units;
}

bool sameUnit(const FmuUnit& a, const FmuUnit& b) {
  if (!a.has_base || !b.has_base) return a.name == b.name;
  return a.factor == b.factor && a.kg == b.kg && a.m == b.m && a.s == b.s && a.rad == b.rad &&
         a.K == b.K;
}

std::string unitName(const std::string& unit, bool real) {
  return unit.empty() && real ? "1" : unit;
}

const FmuUnit& fmuUnit(const std::string& name) {
  const auto& units = fmuUnits();
  const auto it =
      std::find_if(units.begin(), units.end(), [&](const FmuUnit& u) { return u.name == name; });
  if (it == units.end()) throw Error(ExitCode::kBadInput, "unit '" + name + "' is not defined");
  return *it;
}

}  // namespace ballbot
