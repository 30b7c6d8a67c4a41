#include <cmath>

#include <nlohmann/json.hpp>

#include "experiment/scenario_keys.hpp"
#include "report/json_text.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

void addRange(const Range& range, Json& out) {
  if (range.low == kTiny) {
    out["exclusiveMinimum"] = 0;
  } else if (std::isfinite(range.low)) {
    out["minimum"] = range.low;
  }
  if (std::isfinite(range.high)) out["maximum"] = range.high;
}

Json mapping() {
  return {{"type", "object"},
          {"additionalProperties", false},
          {"properties", {{"include", {{"description", "file whose keys stand here as well"}}}}}};
}

Json schemaOf(const KeyEntry& e) {
  Json out;
  switch (e.kind) {
    case KeyKind::kNumber:
    case KeyKind::kDuration:
      out["type"] = "number";
      addRange(e.range, out);
      break;
    case KeyKind::kInteger:
      out["type"] = "integer";
      addRange(e.range, out);
      break;
    case KeyKind::kBoolean:
      out["type"] = "boolean";
      break;
    case KeyKind::kText:
      out["type"] = "string";
      break;
    case KeyKind::kChoice:
      out["enum"] = e.choices;
      break;
    case KeyKind::kNumbers: {
      Json item = {{"type", "number"}};
      addRange(e.range, item);
      out = {{"type", "array"}, {"items", item}, {"minItems", e.count}, {"maxItems", e.count}};
      break;
    }
    case KeyKind::kSection:
      out = mapping();
      break;
    case KeyKind::kList:
      out = {{"type", "array"}, {"items", mapping()}};
      break;
    case KeyKind::kOther:
      break;
  }
  std::string words = e.words;
  if (!e.unit.empty()) words += " [" + e.unit + "]";
  if (!e.other.empty()) words += ": " + e.other;
  if (!e.required && !e.fallback.empty()) words += "; default " + e.fallback;
  out["description"] = words;
  return out;
}

/// The properties that a dotted path lies in, and its last word.
Json& parentOf(const std::string& path, Json& root, std::string& last) {
  Json* at = &root;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1) {
    const std::string word = path.substr(begin, dot - begin);
    at = word == "0" ? &(*at)["items"] : &(*at)["properties"][word];
  }
  last = path.substr(begin);
  return *at;
}

}  // namespace

std::string scenarioSchema() {
  Json root = mapping();
  root["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  root["title"] = "Scenario of ballbot";
  for (const KeyEntry& entry : scenarioKeys()) {
    std::string last;
    Json& parent = parentOf(entry.path, root, last);
    parent["properties"][last] = schemaOf(entry);
  }
  return jsonText(root) + "\n";
}

}  // namespace ballbot
