#pragma once

#include <string>

#include <tinyxml2.h>

#include "fmi/model_description.hpp"

namespace ballbot {

// What the model descriptions of both versions have in common.

/// "ballbot_contact", from the parameter's path.
std::string enumerationName(const FmuVariable& variable);
const char* causalityName(VariableRole role);

/// A new last child. Attributes are added by the caller, in the order of the standard's tables.
tinyxml2::XMLElement* addChild(tinyxml2::XMLElement* parent, const char* name);
void setAttribute(tinyxml2::XMLElement* element, const char* name, const std::string& value);

/// The document with its root; text of the finished document.
tinyxml2::XMLElement* beginDescription(tinyxml2::XMLDocument& document, const char* fmi_version);
void describeModel(tinyxml2::XMLElement* root, const ModelFacts& facts,
                   const char* token_attribute);
void addUnits(tinyxml2::XMLElement* root);
void addLogCategories(tinyxml2::XMLElement* root);
void addDefaultExperiment(tinyxml2::XMLElement* root, const ModelFacts& facts);
std::string xmlText(const tinyxml2::XMLDocument& document);

}  // namespace ballbot
