#include "fmi/fmu_description.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "fmi/array_element.hpp"
#include "fmi/fmu_xml.hpp"
#include "fmi/zip_archive.hpp"

namespace ballbot {
namespace {

/// Room for half a million variables. A few bytes of an archive can unpack to any length.
constexpr std::uint64_t kLongestDescription = std::uint64_t{128} << 20;

std::string outOfRange(double low, double high) {
  return low == high ? fmt::format("must be {}", low)
                     : fmt::format("must be between {} and {}", low, high);
}

void addNames(FmuDescription& fmu) {
  const auto add = [&](const std::string& name, std::size_t place) {
    if (fmu.by_name.emplace(name, place).second) return;
    throw InputError(
        fmt::format("{}: modelDescription.xml: two variables have the name '{}'", fmu.file, name));
  };
  for (std::size_t i = 0; i < fmu.variables.size(); ++i) {
    add(fmu.variables[i].name, i);
    for (const std::string& alias : fmu.variables[i].aliases) add(alias, i);
  }
}

bool alike(const ImportedVariable& a, const ImportedVariable& b) {
  return a.role == b.role && a.type == b.type && a.unit == b.unit;
}

/// Scalars that a common name stands for: numbered without gaps, and all of one kind.
void addRows(FmuDescription& fmu) {
  std::unordered_map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> found;
  for (std::size_t i = 0; i < fmu.variables.size(); ++i) {
    const ImportedVariable& v = fmu.variables[i];
    const auto parts = splitElement(v.name);
    const auto index = parts ? wholeNumber(parts->second) : std::nullopt;
    if (index && v.dimensions.empty()) found[parts->first].emplace_back(*index, i);
  }
  for (auto& [name, elements] : found) {
    if (fmu.by_name.count(name) != 0) continue;
    std::sort(elements.begin(), elements.end());
    VariableRow row{elements.front().first, {}};
    bool good = row.first_index <= 1;
    for (const auto& [index, place] : elements) {
      good = good && index == row.first_index + row.variables.size() &&
             alike(fmu.variables[place], fmu.variables[elements.front().second]);
      row.variables.push_back(place);
    }
    if (good) fmu.rows.emplace(name, std::move(row));
  }
}

}  // namespace

std::string refusalOf(const ImportedVariable& v, double value) {
  const FmuType& type = *v.facts;
  if (type.kind == ValueKind::kReal) {
    const bool fits = !std::isfinite(value) || (value >= type.low && value <= type.high);
    return fits ? "" : outOfRange(type.low, type.high);
  }
  if (type.kind == ValueKind::kBoolean) {
    return value == 0 || value == 1 ? "" : "must be true or false, or 1 or 0";
  }
  if (v.items) {
    if (std::binary_search(v.items->begin(), v.items->end(), value)) return "";
    if (v.items->size() > 20) return "is none of the numbers of its enumeration";
    return fmt::format("must be one of the numbers of its enumeration: {}",
                       fmt::join(*v.items, ", "));
  }
  const bool fits = value == std::floor(value) && value >= type.low && value <= type.high;
  return fits
             ? ""
             : fmt::format("must be a whole number between {:.0f} and {:.0f}", type.low, type.high);
}

const ImportedVariable* FmuDescription::find(const std::string& name) const {
  const auto it = by_name.find(name);
  return it == by_name.end() ? nullptr : &variables[it->second];
}

std::string FmuDescription::rowOf(const ImportedVariable& variable) const {
  const auto parts = splitElement(variable.name);
  const bool whole = parts && variable.dimensions.empty() && wholeNumber(parts->second);
  return whole && rows.count(parts->first) != 0 ? parts->first : "";
}

std::string FmuDescription::binaryPath() const {
  return fmt::format("binaries/{}/{}.so", fmi_version == 2 ? "linux64" : "x86_64-linux",
                     model_identifier);
}

FmuDescription readFmuDescription(const std::string& path) {
  const std::string xml = readFromZip(path, "modelDescription.xml", kLongestDescription);
  FmuDescription out = parseFmuDescription(xml, path);
  addNames(out);
  addRows(out);
  out.has_binary = zipHas(path, out.binaryPath());
  return out;
}

}  // namespace ballbot
