#include "fmi/fmu_ports.hpp"

#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/nearest_word.hpp"
#include "fmi/array_element.hpp"

namespace ballbot {
namespace {

FmuPort portOfVariable(const ImportedVariable& v) {
  return {v.name, v.aliases, {v}, v.size, v.dimensions, 1};
}

FmuPort portOfRow(const FmuDescription& fmu, const std::string& name) {
  const VariableRow& row = fmu.rows.at(name);
  FmuPort port;
  port.name = name;
  port.first_index = row.first_index;
  port.size = static_cast<int>(row.variables.size());
  port.dimensions = {row.variables.size()};
  for (const std::size_t i : row.variables) port.variables.push_back(fmu.variables[i]);
  return port;
}

[[noreturn]] void refuseName(const FmuDescription& fmu, const std::string& name) {
  std::set<std::string> names;
  for (const auto& [known, place] : fmu.by_name) names.insert(known);
  for (const auto& [known, row] : fmu.rows) names.insert(known);
  if (fmu.find(name + "[0]") || fmu.find(name + "[1]")) {
    throw InputError(fmt::format(
        "{}: '{}' is no row: its elements are not numbered without gaps from 0 or 1, or "
        "are of different causality, type or unit. Name them one by one",
        fmu.file, name));
  }
  const std::string near = nearestWord(name, names);
  throw InputError(fmt::format("{}: has no variable '{}'{}", fmu.file, name,
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

}  // namespace

FmuPort findPortOr(const FmuDescription& fmu, const std::string& name) {
  if (const ImportedVariable* v = fmu.find(name)) return portOfVariable(*v);
  return fmu.rows.count(name) != 0 ? portOfRow(fmu, name) : FmuPort{};
}

FmuPort findPort(const FmuDescription& fmu, const std::string& name) {
  FmuPort port = findPortOr(fmu, name);
  if (port.variables.empty()) refuseName(fmu, name);
  if (port.size > 0) return port;
  throw InputError(
      fmt::format("{}: the size of '{}' is not fixed, or beyond a million; such arrays cannot be "
                  "connected",
                  fmu.file, name));
}

FmuPort findPortOf(const FmuDescription& fmu, const std::string& end) {
  if (const ImportedVariable* v = fmu.find(end)) {
    const std::string row = fmu.rowOf(*v);
    return findPort(fmu, row.empty() ? end : row);
  }
  const auto parts = splitElement(end);
  const FmuPort whole = parts ? findPortOr(fmu, parts->first) : FmuPort{};
  return findPort(fmu, whole.dimensions.empty() ? end : parts->first);
}

std::vector<FmuPort> allPorts(const FmuDescription& fmu) {
  std::vector<FmuPort> out;
  for (std::size_t i = 0; i < fmu.variables.size(); ++i) {
    const std::string row = fmu.rowOf(fmu.variables[i]);
    if (row.empty()) {
      out.push_back(portOfVariable(fmu.variables[i]));
    } else if (fmu.rows.at(row).variables.front() == i) {
      out.push_back(portOfRow(fmu, row));
    }
  }
  return out;
}

}  // namespace ballbot
