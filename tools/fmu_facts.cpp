#include "tools/fmu_facts.hpp"

#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "fmi/fmu_ports.hpp"

namespace ballbot {
namespace {

const char* roleText(VariableRole role) {
  switch (role) {
    case VariableRole::kTime:
      return "independent";
    case VariableRole::kInput:
      return "input";
    case VariableRole::kOutput:
      return "output";
    case VariableRole::kParameter:
      return "parameter";
    case VariableRole::kLocal:
      break;
  }
  return "local";
}

/// "3", "3,3"; of a row that counts from 0 the last number.
std::vector<std::size_t> shownDimensions(const FmuPort& port) {
  return port.first_index == 0 ? std::vector{port.dimensions.front() - 1} : port.dimensions;
}

std::string portText(const FmuPort& port) {
  const ImportedVariable& v = port.first();
  const std::string name =
      port.dimensions.empty()
          ? port.name
          : fmt::format("{}[{}{}]", port.name, port.first_index == 0 ? "0.." : "",
                        fmt::join(shownDimensions(port), ","));
  const bool parameter = v.role == VariableRole::kParameter;
  return fmt::format(
      "  {:<52} {:<12} {:<8} {}{}{}\n", name, v.type, v.unit, v.description,
      parameter ? fmt::format(" (start: {})", v.start) : "",
      port.aliases.empty() ? "" : fmt::format(" (also: {})", fmt::join(port.aliases, ", ")));
}

const char* yesOrNo(bool yes) { return yes ? "yes" : "no"; }

/// Outputs that change at once with an input: what closes loops.
std::size_t feedThroughCount(const FmuDescription& fmu) {
  std::set<ValueReference> inputs;
  for (const ImportedVariable& v : fmu.variables) {
    if (v.role == VariableRole::kInput) inputs.insert(v.reference);
  }
  std::size_t count = 0;
  for (const ImportedVariable& v : fmu.variables) {
    if (v.role != VariableRole::kOutput) continue;
    bool depends = v.depends_on_all && !inputs.empty();
    for (const ValueReference r : v.depends_on) depends = depends || inputs.count(r) != 0;
    count += depends ? 1 : 0;
  }
  return count;
}

}  // namespace

std::string fmuFactsText(const FmuDescription& fmu) {
  std::string out =
      fmt::format("{}: {}, FMI {} for Co-Simulation{}\n", fmu.file, fmu.model_name, fmu.fmi_version,
                  fmu.generation_tool.empty() ? "" : ", made by " + fmu.generation_tool);
  if (!fmu.description.empty()) out += fmt::format("  {}\n", fmu.description);
  out += fmt::format(
      "  state can be saved: {}\n  steps of any size: {}\n  needs a tool: {}\n"
      "  runs on this kind of machine: {} ({})\n"
      "  outputs that follow inputs at once: {}\n",
      yesOrNo(fmu.saves_state), yesOrNo(fmu.variable_steps), yesOrNo(fmu.needs_execution_tool),
      yesOrNo(fmu.has_binary), fmu.binaryPath(), feedThroughCount(fmu));
  const std::vector<FmuPort> ports = allPorts(fmu);
  const std::pair<VariableRole, const char*> groups[] = {{VariableRole::kInput, "inputs"},
                                                         {VariableRole::kOutput, "outputs"},
                                                         {VariableRole::kParameter, "parameters"},
                                                         {VariableRole::kLocal, "local"}};
  for (const auto& [role, title] : groups) {
    std::string lines;
    for (const FmuPort& port : ports) {
      if (port.first().role == role) lines += portText(port);
    }
    if (!lines.empty()) out += fmt::format("{}\n{}", title, lines);
  }
  return out;
}

nlohmann::ordered_json fmuFactsJson(const FmuDescription& fmu) {
  using nlohmann::ordered_json;
  ordered_json out;
  out["file"] = fmu.file;
  out["fmi_version"] = fmu.fmi_version;
  out["model_name"] = fmu.model_name;
  out["description"] = fmu.description;
  out["generation_tool"] = fmu.generation_tool;
  out["saves_state"] = fmu.saves_state;
  out["variable_steps"] = fmu.variable_steps;
  out["needs_execution_tool"] = fmu.needs_execution_tool;
  out["has_binary"] = fmu.has_binary;
  out["variables"] = ordered_json::array();
  for (const FmuPort& port : allPorts(fmu)) {
    const ImportedVariable& v = port.first();
    out["variables"].push_back({{"name", port.name},
                                {"causality", roleText(v.role)},
                                {"type", v.type},
                                {"size", port.size},
                                {"unit", v.unit},
                                {"start", v.start},
                                {"description", v.description}});
    ordered_json& entry = out["variables"].back();
    if (!port.dimensions.empty()) entry["dimensions"] = port.dimensions;
    if (port.first_index != 1) entry["first_index"] = port.first_index;
    if (!port.aliases.empty()) entry["aliases"] = port.aliases;
  }
  return out;
}

}  // namespace ballbot
