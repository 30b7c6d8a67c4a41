#include "fmi/model_xml.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/number_text.hpp"
#include "fmi/fmu_instance.hpp"
#include "fmi/units.hpp"

namespace ballbot {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

std::string enumerationName(const FmuVariable& variable) {
  return "ballbot_" + variable.name.substr(variable.name.rfind('.') + 1);
}

const char* causalityName(VariableRole role) {
  switch (role) {
    case VariableRole::kTime:
      return "independent";
    case VariableRole::kInput:
      return "input";
    case VariableRole::kOutput:
      return "output";
    case VariableRole::kLocal:
      return "local";
    case VariableRole::kParameter:
      return "parameter";
  }
  return "local";
}

XMLElement* addChild(XMLElement* parent, const char* name) {
  return parent->InsertNewChildElement(name);
}

void setAttribute(XMLElement* element, const char* name, const std::string& value) {
  element->SetAttribute(name, value.c_str());
}

XMLElement* beginDescription(XMLDocument& document, const char* fmi_version) {
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* root = document.NewElement("fmiModelDescription");
  document.InsertEndChild(root);
  root->SetAttribute("fmiVersion", fmi_version);
  return root;
}

void describeModel(XMLElement* root, const ModelFacts& facts, const char* token_attribute) {
  root->SetAttribute("modelName", kModelIdentifier);
  setAttribute(root, token_attribute, facts.token);
  setAttribute(root, "description", facts.description);
  setAttribute(root, "version", facts.version);
  setAttribute(root, "generationTool", "ballbot " + facts.version);
  root->SetAttribute("variableNamingConvention", "structured");
}

void addUnits(XMLElement* root) {
  XMLElement* list = addChild(root, "UnitDefinitions");
  for (const FmuUnit& unit : fmuUnits()) {
    XMLElement* u = addChild(list, "Unit");
    setAttribute(u, "name", unit.name);
    if (!unit.has_base) continue;
    XMLElement* base = addChild(u, "BaseUnit");
    const std::pair<const char*, int> exponents[] = {
        {"kg", unit.kg}, {"m", unit.m}, {"s", unit.s}, {"K", unit.K}, {"rad", unit.rad}};
    for (const auto& [name, exponent] : exponents) {
      if (exponent != 0) base->SetAttribute(name, exponent);
    }
    if (unit.factor != 1) setAttribute(base, "factor", numberText(unit.factor));
  }
}

void addLogCategories(XMLElement* root) {
  XMLElement* list = addChild(root, "LogCategories");
  const std::pair<const char*, const char*> categories[] = {
      {kLogErrors, "Why a call returned an error"}, {kLogEvents, "Initialization, termination"}};
  for (const auto& [name, text] : categories) {
    XMLElement* category = addChild(list, "Category");
    category->SetAttribute("name", name);
    category->SetAttribute("description", text);
  }
}

void addDefaultExperiment(XMLElement* root, const ModelFacts& facts) {
  XMLElement* experiment = addChild(root, "DefaultExperiment");
  experiment->SetAttribute("startTime", "0");
  setAttribute(experiment, "stopTime", numberText(facts.stop_time_s));
  setAttribute(experiment, "stepSize", numberText(facts.internal_step_s));
}

std::string xmlText(const XMLDocument& document) {
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace ballbot
