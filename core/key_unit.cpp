#include "core/key_unit.hpp"

#include <map>
#include <sstream>
#include <vector>

namespace ballbot {
namespace {

const std::map<std::string, std::string>& units() {
  static const std::map<std::string, std::string> table = {
      {"A", "A"},           {"Hz", "Hz"},       {"J", "J"},
      {"K", "K"},           {"N", "N"},         {"Nm", "N m"},
      {"Nms", "N m s"},     {"V", "V"},         {"W", "W"},
      {"deg", "deg"},       {"kbps", "kbit/s"}, {"kg", "kg"},
      {"kgm2", "kg m^2"},   {"m", "m"},         {"mm", "mm"},
      {"ms", "ms"},         {"percent", "%"},   {"rad", "rad"},
      {"s", "s"},           {"s2", "s^2"},      {"sqrtHz", "sqrt(Hz)"},
      {"sqrts", "sqrt(s)"}, {"us", "us"},
  };
  return table;
}

}  // namespace

std::string unitOfKey(const std::string& name) {
  std::vector<std::string> words;
  std::istringstream parts(name);
  for (std::string word; std::getline(parts, word, '_');) words.push_back(word);
  // From the end: a unit, then any number of "UNIT per" before it. The first word is never one.
  std::string unit;
  for (std::size_t i = words.size(); i-- > 1;) {
    const auto found = units().find(words[i]);
    if (found == units().end()) break;
    unit = found->second + (unit.empty() ? "" : "/" + unit);
    if (i < 3 || words[i - 1] != "per") break;
    --i;
  }
  return unit;
}

}  // namespace ballbot
