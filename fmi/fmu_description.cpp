#include "fmi/fmu_description.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <set>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/error.hpp"
#include "core/nearest_word.hpp"
#include "fmi/zip_archive.hpp"

namespace ballbot {
namespace {

using tinyxml2::XMLElement;

std::string attribute(const XMLElement* e, const char* name) {
  const char* text = e ? e->Attribute(name) : nullptr;
  return text ? text : "";
}

bool flag(const XMLElement* e, const char* name) {
  const std::string text = attribute(e, name);
  return text == "true" || text == "1";
}

/// Calls work(child) for all element children, of the given name if one is given.
template <typename Work>
void forChildren(const XMLElement* parent, const char* name, Work&& work) {
  if (!parent) return;
  for (const XMLElement* e = parent->FirstChildElement(name); e; e = e->NextSiblingElement(name))
    work(e);
}

VariableRole roleOf(const std::string& causality) {
  if (causality == "input") return VariableRole::kInput;
  if (causality == "output") return VariableRole::kOutput;
  if (causality == "parameter" || causality == "structuralParameter")
    return VariableRole::kParameter;
  if (causality == "independent") return VariableRole::kTime;
  return VariableRole::kLocal;
}

std::vector<ValueReference> numbers(const std::string& text) {
  std::vector<ValueReference> out;
  const char* at = text.c_str();
  for (char* end = nullptr;; at = end) {
    const unsigned long value = std::strtoul(at, &end, 10);
    if (end == at) return out;
    out.push_back(static_cast<ValueReference>(value));
  }
}

void readUnits(const XMLElement* root, FmuDescription& out) {
  forChildren(root->FirstChildElement("UnitDefinitions"), "Unit", [&](const XMLElement* e) {
    FmuUnit unit{attribute(e, "name")};
    if (const XMLElement* base = e->FirstChildElement("BaseUnit")) {
      unit.factor = base->DoubleAttribute("factor", 1);
      unit.kg = base->IntAttribute("kg");
      unit.m = base->IntAttribute("m");
      unit.s = base->IntAttribute("s");
      unit.rad = base->IntAttribute("rad");
      // Of units with other dimensions, or an offset, only the name is compared.
      const bool known = base->DoubleAttribute("offset", 0) == 0 && !base->IntAttribute("A") &&
                         !base->IntAttribute("K") && !base->IntAttribute("mol") &&
                         !base->IntAttribute("cd");
      unit.has_base = known;
    }
    out.units.push_back(unit);
  });
}

/// Units that types declare for the variables of that type.
std::string declaredUnit(const XMLElement* root, const std::string& type_name, int fmi_version) {
  std::string unit;
  forChildren(root->FirstChildElement("TypeDefinitions"), nullptr, [&](const XMLElement* e) {
    if (attribute(e, "name") != type_name) return;
    unit = attribute(fmi_version == 2 ? e->FirstChildElement() : e, "unit");
  });
  return unit;
}

void readVariables(const XMLElement* root, FmuDescription& out) {
  forChildren(root->FirstChildElement("ModelVariables"), nullptr, [&](const XMLElement* e) {
    ImportedVariable v;
    const XMLElement* type = out.fmi_version == 2 ? e->FirstChildElement() : e;
    if (!type) return;
    v.name = attribute(e, "name");
    v.type = type->Name();
    v.role = roleOf(attribute(e, "causality"));
    v.reference = e->UnsignedAttribute("valueReference");
    v.description = attribute(e, "description");
    v.unit = attribute(type, "unit");
    v.start = attribute(type, "start");
    const std::string declared = attribute(type, "declaredType");
    if (v.unit.empty() && !declared.empty()) v.unit = declaredUnit(root, declared, out.fmi_version);
    forChildren(out.fmi_version == 3 ? e : nullptr, "Dimension", [&](const XMLElement* d) {
      v.size *= d->IntAttribute("start", 0);  // 0: resizable, which connections refuse
    });
    out.variables.push_back(std::move(v));
  });
}

void readDependencies(const XMLElement* root, FmuDescription& out) {
  const XMLElement* structure = root->FirstChildElement("ModelStructure");
  const bool two = out.fmi_version == 2;
  if (two && structure) structure = structure->FirstChildElement("Outputs");
  forChildren(structure, two ? "Unknown" : "Output", [&](const XMLElement* e) {
    ImportedVariable* unknown = nullptr;
    if (two) {
      const unsigned index = e->UnsignedAttribute("index");
      if (index >= 1 && index <= out.variables.size()) unknown = &out.variables[index - 1];
    } else {
      const unsigned reference = e->UnsignedAttribute("valueReference");
      for (ImportedVariable& v : out.variables) {
        if (v.reference == reference) unknown = &v;
      }
    }
    if (!unknown || !e->Attribute("dependencies")) return;
    unknown->depends_on_all = false;
    for (const ValueReference n : numbers(attribute(e, "dependencies"))) {
      if (!two) {
        unknown->depends_on.push_back(n);
      } else if (n >= 1 && n <= out.variables.size()) {
        unknown->depends_on.push_back(out.variables[n - 1].reference);
      }
    }
  });
}

}  // namespace

const ImportedVariable* FmuDescription::find(const std::string& name) const {
  const auto it = std::find_if(variables.begin(), variables.end(),
                               [&](const ImportedVariable& v) { return v.name == name; });
  return it == variables.end() ? nullptr : &*it;
}

std::string FmuDescription::binaryPath() const {
  return fmt::format("binaries/{}/{}.so", fmi_version == 2 ? "linux64" : "x86_64-linux",
                     model_identifier);
}

FmuDescription readFmuDescription(const std::string& path) {
  const std::string xml = readFromZip(path, "modelDescription.xml");
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(fmt::format("{}: modelDescription.xml:{}: not valid XML: {}", path,
                                 document.ErrorLineNum(), document.ErrorName()));
  }
  const XMLElement* root = document.FirstChildElement("fmiModelDescription");
  if (!root) throw InputError(path + ": modelDescription.xml does not describe an FMU");
  FmuDescription out;
  out.file = path;
  const std::string version = attribute(root, "fmiVersion");
  if (version.rfind("2.", 0) == 0) out.fmi_version = 2;
  if (version.rfind("3.", 0) == 0) out.fmi_version = 3;
  if (out.fmi_version == 0) {
    throw InputError(fmt::format("{}: is of FMI version '{}', must be 2 or 3", path, version));
  }
  const XMLElement* co_simulation = root->FirstChildElement("CoSimulation");
  if (!co_simulation)
    throw InputError(path + ": is not for Co-Simulation; export it for Co-Simulation");
  const bool two = out.fmi_version == 2;
  out.model_name = attribute(root, "modelName");
  out.description = attribute(root, "description");
  out.generation_tool = attribute(root, "generationTool");
  out.token = attribute(root, two ? "guid" : "instantiationToken");
  out.model_identifier = attribute(co_simulation, "modelIdentifier");
  out.saves_state = flag(co_simulation, two ? "canGetAndSetFMUstate" : "canGetAndSetFMUState") &&
                    flag(co_simulation, two ? "canSerializeFMUstate" : "canSerializeFMUState");
  out.variable_steps = flag(co_simulation, "canHandleVariableCommunicationStepSize");
  out.needs_execution_tool = flag(co_simulation, "needsExecutionTool");
  readUnits(root, out);
  readVariables(root, out);
  readDependencies(root, out);
  out.has_binary = zipHas(path, out.binaryPath());
  return out;
}

FmuPort findPortOr(const FmuDescription& fmu, const std::string& name) {
  FmuPort port;
  port.name = name;
  if (const ImportedVariable* v = fmu.find(name)) {
    port.variables.push_back(*v);
    port.size = v->size;
    return port;
  }
  while (const ImportedVariable* v = fmu.find(fmt::format("{}[{}]", name, port.size + 1))) {
    port.variables.push_back(*v);
    ++port.size;
  }
  return port;
}

FmuPort findPort(const FmuDescription& fmu, const std::string& name) {
  FmuPort port = findPortOr(fmu, name);
  if (port.size > 0) return port;
  if (!port.variables.empty()) {
    throw InputError(fmt::format(
        "{}: the size of '{}' is not fixed; such arrays cannot be connected", fmu.file, name));
  }
  std::set<std::string> names;
  for (const ImportedVariable& v : fmu.variables) {
    names.insert(v.name);
    names.insert(v.name.substr(0, v.name.find('[')));
  }
  const std::string near = nearestWord(name, names);
  throw InputError(fmt::format("{}: has no variable '{}'{}", fmu.file, name,
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

}  // namespace ballbot
