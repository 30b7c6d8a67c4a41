#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fmi/model_xml.hpp"

namespace ballbot {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

const char* typeElement(VariableType type) {
  switch (type) {
    case VariableType::kReal:
      return "Real";
    case VariableType::kInteger:
      return "Integer";
    case VariableType::kBoolean:
      return "Boolean";
    case VariableType::kEnumeration:
      return "Enumeration";
  }
  return "Real";
}

std::string startText(const FmuVariable& v) {
  if (v.type == VariableType::kBoolean) return v.start != 0 ? "true" : "false";
  if (v.type == VariableType::kInteger &&
      std::abs(v.start) > std::numeric_limits<std::int32_t>::max()) {
    throw InputError(
        fmt::format("'{}' is {}, but FMI 2 has 32-bit integers only. Choose a smaller value, or "
                    "export for FMI 3",
                    v.name, v.start));
  }
  return numberText(v.start);
}

void addTypes(XMLElement* root, const FmuVariables& variables) {
  XMLElement* list = addChild(root, "TypeDefinitions");
  for (const FmuVariable& v : variables.all()) {
    if (v.type != VariableType::kEnumeration) continue;
    XMLElement* type = addChild(list, "SimpleType");
    setAttribute(type, "name", enumerationName(v));
    XMLElement* enumeration = addChild(type, "Enumeration");
    for (std::size_t i = 0; i < v.choices.size(); ++i) {
      XMLElement* item = addChild(enumeration, "Item");
      setAttribute(item, "name", v.choices[i]);
      item->SetAttribute("value", static_cast<unsigned>(i + 1));
    }
  }
}

void addVariable(XMLElement* list, const FmuVariable& v, int element) {
  XMLElement* scalar = addChild(list, "ScalarVariable");
  setAttribute(scalar, "name", elementName(v, element));
  scalar->SetAttribute("valueReference", v.reference + static_cast<ValueReference>(element));
  setAttribute(scalar, "description", v.description);
  scalar->SetAttribute("causality", causalityName(v.role));
  const bool parameter = v.role == VariableRole::kParameter;
  scalar->SetAttribute("variability", parameter      ? "fixed"
                                      : v.continuous ? "continuous"
                                                     : "discrete");
  if (parameter) scalar->SetAttribute("initial", "exact");
  if (v.role == VariableRole::kOutput || v.role == VariableRole::kLocal) {
    scalar->SetAttribute("initial", "calculated");
  }
  XMLElement* type = addChild(scalar, typeElement(v.type));
  if (v.type == VariableType::kEnumeration) setAttribute(type, "declaredType", enumerationName(v));
  if (!v.unit.empty()) setAttribute(type, "unit", v.unit);
  if (v.hasStart()) setAttribute(type, "start", startText(v));
}

/// Index of a value in ModelVariables, where each element stands alone and in the order of the
/// references.
unsigned indexOf(ValueReference reference) { return reference + 1; }

void addStructure(XMLElement* root, const FmuVariables& variables) {
  XMLElement* structure = addChild(root, "ModelStructure");
  // A command acts within the step that follows, so no output depends on an input of its own time.
  XMLElement* outputs = addChild(structure, "Outputs");
  // At the start the parameters decide, and no input does.
  XMLElement* unknowns = addChild(structure, "InitialUnknowns");
  std::string parameters;
  for (const FmuVariable& v : variables.all()) {
    if (v.role == VariableRole::kParameter) {
      parameters += fmt::format("{}{}", parameters.empty() ? "" : " ", indexOf(v.reference));
    }
  }
  for (const FmuVariable& v : variables.all()) {
    if (v.role != VariableRole::kOutput) continue;
    for (int i = 0; i < v.size; ++i) {
      const unsigned index = indexOf(v.reference + static_cast<ValueReference>(i));
      XMLElement* output = addChild(outputs, "Unknown");
      output->SetAttribute("index", index);
      output->SetAttribute("dependencies", "");
      XMLElement* unknown = addChild(unknowns, "Unknown");
      unknown->SetAttribute("index", index);
      setAttribute(unknown, "dependencies", parameters);
    }
  }
}

}  // namespace

std::string fmi2ModelDescription(const FmuVariables& variables, const ModelFacts& facts) {
  XMLDocument document;
  XMLElement* root = beginDescription(document, "2.0");
  describeModel(root, facts, "guid");
  XMLElement* co_simulation = addChild(root, "CoSimulation");
  co_simulation->SetAttribute("modelIdentifier", kModelIdentifier);
  co_simulation->SetAttribute("needsExecutionTool", false);
  co_simulation->SetAttribute("canHandleVariableCommunicationStepSize", true);
  co_simulation->SetAttribute("canInterpolateInputs", false);
  co_simulation->SetAttribute("maxOutputDerivativeOrder", 0);
  co_simulation->SetAttribute("canRunAsynchronuously", false);  // the standard's spelling
  co_simulation->SetAttribute("canBeInstantiatedOnlyOncePerProcess", false);
  co_simulation->SetAttribute("canNotUseMemoryManagementFunctions", true);
  co_simulation->SetAttribute("canGetAndSetFMUstate", true);
  co_simulation->SetAttribute("canSerializeFMUstate", true);
  co_simulation->SetAttribute("providesDirectionalDerivative", false);
  addUnits(root);
  addTypes(root, variables);
  addLogCategories(root);
  addDefaultExperiment(root, facts);
  XMLElement* list = addChild(root, "ModelVariables");
  for (const FmuVariable& v : variables.all()) {
    for (int i = 0; i < v.size; ++i) addVariable(list, v, i);
  }
  addStructure(root, variables);
  return xmlText(document);
}

}  // namespace ballbot
