#include <fmt/format.h>

#include "core/number_text.hpp"
#include "fmi/model_xml.hpp"

namespace ballbot {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

const char* typeElement(VariableType type) {
  switch (type) {
    case VariableType::kReal:
      return "Float64";
    case VariableType::kInteger:
      return "Int64";
    case VariableType::kBoolean:
      return "Boolean";
    case VariableType::kEnumeration:
      return "Enumeration";
  }
  return "Float64";
}

std::string startText(const FmuVariable& v) {
  if (v.type == VariableType::kBoolean) return v.start != 0 ? "true" : "false";
  const std::string one = v.type == VariableType::kReal
                              ? numberText(v.start)
                              : fmt::format("{}", static_cast<std::int64_t>(v.start));
  std::string all = one;
  for (int i = 1; i < v.size; ++i) all += " " + one;
  return all;
}

void addTypes(XMLElement* root, const FmuVariables& variables) {
  XMLElement* list = addChild(root, "TypeDefinitions");
  for (const FmuVariable& v : variables.all()) {
    if (v.type != VariableType::kEnumeration) continue;
    XMLElement* type = addChild(list, "EnumerationType");
    setAttribute(type, "name", enumerationName(v));
    for (std::size_t i = 0; i < v.choices.size(); ++i) {
      XMLElement* item = addChild(type, "Item");
      setAttribute(item, "name", v.choices[i]);
      item->SetAttribute("value", static_cast<unsigned>(i + 1));
    }
  }
}

void addVariable(XMLElement* list, const FmuVariable& v) {
  XMLElement* e = addChild(list, typeElement(v.type));
  setAttribute(e, "name", v.name);
  e->SetAttribute("valueReference", v.reference);
  setAttribute(e, "description", v.description);
  e->SetAttribute("causality", causalityName(v.role));
  const bool parameter = v.role == VariableRole::kParameter;
  e->SetAttribute("variability", parameter ? "fixed" : v.continuous ? "continuous" : "discrete");
  if (parameter) e->SetAttribute("initial", "exact");
  if (v.role == VariableRole::kOutput || v.role == VariableRole::kLocal) {
    e->SetAttribute("initial", "calculated");
  }
  if (v.type == VariableType::kEnumeration) setAttribute(e, "declaredType", enumerationName(v));
  if (!v.unit.empty()) setAttribute(e, "unit", v.unit);
  if (v.hasStart()) setAttribute(e, "start", startText(v));
  if (v.isArray()) addChild(e, "Dimension")->SetAttribute("start", v.size);
}

void addStructure(XMLElement* root, const FmuVariables& variables) {
  XMLElement* structure = addChild(root, "ModelStructure");
  std::string parameters;
  for (const FmuVariable& v : variables.all()) {
    if (v.role != VariableRole::kParameter) continue;
    parameters += fmt::format("{}{}", parameters.empty() ? "" : " ", v.reference);
  }
  // A command acts within the step that follows, so no output depends on an input of its own time;
  // at the start the parameters decide, and no input does.
  for (const auto& [name, dependencies] :
       {std::pair<const char*, std::string>{"Output", ""}, {"InitialUnknown", parameters}}) {
    for (const FmuVariable& v : variables.all()) {
      if (v.role != VariableRole::kOutput) continue;
      XMLElement* unknown = addChild(structure, name);
      unknown->SetAttribute("valueReference", v.reference);
      setAttribute(unknown, "dependencies", dependencies);
    }
  }
}

}  // namespace

std::string fmi3ModelDescription(const FmuVariables& variables, const ModelFacts& facts) {
  XMLDocument document;
  XMLElement* root = beginDescription(document, "3.0");
  describeModel(root, facts, "instantiationToken");
  XMLElement* co_simulation = addChild(root, "CoSimulation");
  co_simulation->SetAttribute("modelIdentifier", kModelIdentifier);
  co_simulation->SetAttribute("needsExecutionTool", false);
  co_simulation->SetAttribute("canBeInstantiatedOnlyOncePerProcess", false);
  co_simulation->SetAttribute("canGetAndSetFMUState", true);
  co_simulation->SetAttribute("canSerializeFMUState", true);
  co_simulation->SetAttribute("providesDirectionalDerivatives", false);
  co_simulation->SetAttribute("providesAdjointDerivatives", false);
  co_simulation->SetAttribute("providesPerElementDependencies", false);
  co_simulation->SetAttribute("canHandleVariableCommunicationStepSize", true);
  setAttribute(co_simulation, "fixedInternalStepSize", numberText(facts.internal_step_s));
  co_simulation->SetAttribute("maxOutputDerivativeOrder", 0);
  co_simulation->SetAttribute("providesIntermediateUpdate", false);
  co_simulation->SetAttribute("mightReturnEarlyFromDoStep", false);
  co_simulation->SetAttribute("canReturnEarlyAfterIntermediateUpdate", false);
  co_simulation->SetAttribute("hasEventMode", false);
  addUnits(root);
  addTypes(root, variables);
  addLogCategories(root);
  addDefaultExperiment(root, facts);
  XMLElement* list = addChild(root, "ModelVariables");
  for (const FmuVariable& v : variables.all()) addVariable(list, v);
  addStructure(root, variables);
  return xmlText(document);
}

}  // namespace ballbot
