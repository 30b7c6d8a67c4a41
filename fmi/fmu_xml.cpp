#include "fmi/fmu_xml.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/error.hpp"
#include "core/utf8.hpp"

namespace ballbot {
namespace {

using tinyxml2::XMLElement;

/// Elements and attributes, of which a parsed document needs some hundred bytes each: a tree of
/// empty elements takes thirty times its text. A million variables stay below it.
constexpr std::ptrdiff_t kMostMarks = 12'000'000;
/// Elements of one array: more than any connection carries.
constexpr std::size_t kLargestArray = 1'000'000;
/// Names of units are copied to each variable of a type.
constexpr std::size_t kLongestUnit = 200;

std::string attribute(const XMLElement* e, const char* name) {
  const char* text = e ? e->Attribute(name) : nullptr;
  return text ? text : "";
}

bool flag(const XMLElement* e, const char* name) {
  const std::string text = attribute(e, name);
  return text == "true" || text == "1";
}

/// A number as XML writes it, whatever the locale of the process; `fallback` where there is none.
double real(const XMLElement* e, const char* name, double fallback) {
  const std::string text = attribute(e, name);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : fallback;
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

class DescriptionReader {
 public:
  DescriptionReader(const XMLElement* root, const std::string& file) : root_(root) {
    out_.file = file;
  }

  FmuDescription read() {
    readModel();
    readUnits();
    readTypes();
    forChildren(root_->FirstChildElement("ModelVariables"), nullptr,
                [&](const XMLElement* e) { readVariable(e); });
    readDependencies();
    return std::move(out_);
  }

 private:
  /// What a type declares for the variables of that type.
  struct DeclaredType {
    std::string unit;
    const XMLElement* facts = nullptr;  ///< the element with min and max
    std::shared_ptr<const std::vector<double>> items;
  };

  bool two() const { return out_.fmi_version == 2; }
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(out_.file + ": " + why);
  }

  void readModel() {
    const std::string version = attribute(root_, "fmiVersion");
    if (version.rfind("2.", 0) == 0) out_.fmi_version = 2;
    if (version.rfind("3.", 0) == 0) out_.fmi_version = 3;
    if (out_.fmi_version == 0)
      refuse(fmt::format("is of FMI version '{}', must be 2 or 3", version));
    const XMLElement* co = root_->FirstChildElement("CoSimulation");
    if (!co) refuse("is not for Co-Simulation; export it for Co-Simulation");
    out_.model_name = attribute(root_, "modelName");
    out_.description = attribute(root_, "description");
    out_.generation_tool = attribute(root_, "generationTool");
    out_.token = attribute(root_, two() ? "guid" : "instantiationToken");
    out_.model_identifier = attribute(co, "modelIdentifier");
    out_.saves_state = flag(co, two() ? "canGetAndSetFMUstate" : "canGetAndSetFMUState") &&
                       flag(co, two() ? "canSerializeFMUstate" : "canSerializeFMUState");
    out_.variable_steps = flag(co, "canHandleVariableCommunicationStepSize");
    out_.needs_execution_tool = flag(co, "needsExecutionTool");
  }

  std::string unitOf(const XMLElement* e, const char* name) const {
    std::string unit = attribute(e, name);
    if (unit.size() > kLongestUnit) {
      refuse(
          fmt::format("modelDescription.xml:{}: a unit has a name of {} bytes, must be {} at most",
                      e->GetLineNum(), unit.size(), kLongestUnit));
    }
    return unit;
  }

  void readUnits() {
    forChildren(root_->FirstChildElement("UnitDefinitions"), "Unit", [&](const XMLElement* e) {
      FmuUnit unit{unitOf(e, "name")};
      if (const XMLElement* base = e->FirstChildElement("BaseUnit")) {
        unit.factor = real(base, "factor", 1);
        unit.kg = base->IntAttribute("kg");
        unit.m = base->IntAttribute("m");
        unit.s = base->IntAttribute("s");
        unit.rad = base->IntAttribute("rad");
        unit.K = base->IntAttribute("K");
        // Of units with other dimensions, or an offset, only the name is compared.
        const bool known = real(base, "offset", 0) == 0 && !base->IntAttribute("A") &&
                           !base->IntAttribute("mol") && !base->IntAttribute("cd");
        unit.has_base = known;
      }
      out_.units.push_back(unit);
    });
  }

  void readTypes() {
    forChildren(root_->FirstChildElement("TypeDefinitions"), nullptr, [&](const XMLElement* e) {
      DeclaredType type;
      type.facts = two() ? e->FirstChildElement() : e;
      type.unit = unitOf(type.facts, "unit");
      std::vector<double> items;
      // In FMI 2.0 as in 3.0 each item says its number.
      forChildren(type.facts, "Item", [&](const XMLElement* i) {
        items.push_back(real(i, "value", static_cast<double>(items.size() + 1)));
      });
      std::sort(items.begin(), items.end());
      if (!items.empty())
        type.items = std::make_shared<const std::vector<double>>(std::move(items));
      types_.emplace(attribute(e, "name"), std::move(type));
    });
  }

  void readVariable(const XMLElement* e) {
    ImportedVariable v;
    const XMLElement* type = two() ? e->FirstChildElement() : e;
    if (!type) return;
    v.name = attribute(e, "name");
    v.type = type->Name();
    v.facts = &fmuType(v.type);
    v.role = roleOf(attribute(e, "causality"));
    v.reference = e->UnsignedAttribute("valueReference");
    v.description = attribute(e, "description");
    v.unit = unitOf(type, "unit");
    v.start = attribute(type, "start");
    const auto declared = types_.find(attribute(type, "declaredType"));
    if (declared != types_.end()) {
      if (v.unit.empty()) v.unit = declared->second.unit;
      v.minimum = real(declared->second.facts, "min", v.minimum);
      v.maximum = real(declared->second.facts, "max", v.maximum);
      v.items = declared->second.items;
    }
    v.minimum = real(type, "min", v.minimum);
    v.maximum = real(type, "max", v.maximum);
    if (!two()) {
      forChildren(e, "Alias",
                  [&](const XMLElement* a) { v.aliases.push_back(attribute(a, "name")); });
      readDimensions(e, v);
    }
    out_.variables.push_back(std::move(v));
  }

  /// A dimension without a start is one that a structural parameter decides.
  static void readDimensions(const XMLElement* e, ImportedVariable& v) {
    std::size_t size = 1;
    forChildren(e, "Dimension", [&](const XMLElement* d) {
      const double start = real(d, "start", 0);
      const bool good = start >= 1 && start <= static_cast<double>(kLargestArray);
      v.dimensions.push_back(good ? static_cast<std::size_t>(start) : 0);
      size = std::min(size * v.dimensions.back(), kLargestArray + 1);
    });
    v.size = size <= kLargestArray ? static_cast<int>(size) : 0;
  }

  void readDependencies() {
    std::unordered_map<ValueReference, std::size_t> by_reference;
    for (std::size_t i = 0; i < out_.variables.size(); ++i)
      by_reference[out_.variables[i].reference] = i;
    const XMLElement* structure = root_->FirstChildElement("ModelStructure");
    if (two() && structure) structure = structure->FirstChildElement("Outputs");
    forChildren(structure, two() ? "Unknown" : "Output", [&](const XMLElement* e) {
      ImportedVariable* unknown = nullptr;
      if (two()) {
        const unsigned index = e->UnsignedAttribute("index");
        if (index >= 1 && index <= out_.variables.size()) unknown = &out_.variables[index - 1];
      } else {
        const auto it = by_reference.find(e->UnsignedAttribute("valueReference"));
        if (it != by_reference.end()) unknown = &out_.variables[it->second];
      }
      if (unknown && e->Attribute("dependencies")) setDependencies(e, *unknown);
    });
  }

  void setDependencies(const XMLElement* e, ImportedVariable& unknown) const {
    unknown.depends_on_all = false;
    for (const ValueReference n : numbers(attribute(e, "dependencies"))) {
      if (!two()) {
        unknown.depends_on.push_back(n);
      } else if (n >= 1 && n <= out_.variables.size()) {
        unknown.depends_on.push_back(out_.variables[n - 1].reference);
      }
    }
  }

  const XMLElement* root_;
  std::unordered_map<std::string, DeclaredType> types_;
  FmuDescription out_;
};

}  // namespace

FmuDescription parseFmuDescription(const std::string& xml, const std::string& file) {
  const auto marks =
      std::count_if(xml.begin(), xml.end(), [](char c) { return c == '<' || c == '='; });
  if (marks > kMostMarks) {
    throw InputError(
        fmt::format("{}: modelDescription.xml has {} elements and attributes, must be {} at most",
                    file, marks, kMostMarks));
  }
  const std::string converted = isUtf8(xml) ? "" : utf8FromLatin1(xml);
  const std::string& text = converted.empty() ? xml : converted;
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(fmt::format("{}: modelDescription.xml:{}: not valid XML: {}", file,
                                 document.ErrorLineNum(), document.ErrorName()));
  }
  const XMLElement* root = document.FirstChildElement("fmiModelDescription");
  if (!root) throw InputError(file + ": modelDescription.xml does not describe an FMU");
  return DescriptionReader(root, file).read();
}

}  // namespace ballbot
