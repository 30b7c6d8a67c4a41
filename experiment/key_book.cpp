#include "experiment/key_book.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/nearest_word.hpp"
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

/// "pushes.3.force_N" as the listing has it: "pushes.0.force_N".
std::string asListed(const std::string& path) {
  std::string out;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    const std::string word = path.substr(begin, dot - begin);
    const bool number = !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
    out += (out.empty() ? "" : ".") + (number ? std::string("0") : word);
    begin = dot + 1;
  }
  return out;
}

[[noreturn]] void refuse(const KeyBook& book, const std::string& path) {
  std::set<std::string> whole, last;
  const std::string name = path.substr(path.rfind('.') + 1);
  std::string same_name;
  for (const KeyEntry& entry : book.keys) {
    whole.insert(entry.path);
    if (same_name.empty() && entry.path.substr(entry.path.rfind('.') + 1) == name) {
      same_name = entry.path;
    }
  }
  const std::string near = same_name.empty() ? nearestWord(path, whole) : same_name;
  throw InputError(fmt::format("no {} has a key '{}'{} (`ballbot explain` lists the sections)",
                               book.kind, path,
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

}  // namespace

std::vector<KeyEntry> KeyBook::at(const std::string& path) const {
  std::string wanted = asListed(path);
  const std::string item = ".0";  // an item of a list is what the list is of
  if (wanted.size() > item.size() &&
      wanted.compare(wanted.size() - item.size(), item.size(), item) == 0) {
    wanted.resize(wanted.size() - item.size());
  }
  std::vector<KeyEntry> out;
  for (const KeyEntry& entry : keys) {
    const bool below = entry.path.compare(0, wanted.size() + 1, wanted + ".") == 0;
    if (entry.path == wanted || below) out.push_back(entry);
  }
  if (out.empty()) refuse(*this, path);
  return out;
}

std::string KeyBook::schema() const {
  Json root = mapping();
  root["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  root["title"] = kind + " of ballbot";
  root["title"].get_ref<std::string&>()[0] = static_cast<char>(std::toupper(kind[0]));
  for (const KeyEntry& entry : keys) {
    std::string last;
    Json& parent = parentOf(entry.path, root, last);
    parent["properties"][last] = schemaOf(entry);
  }
  return jsonText(root) + "\n";
}

}  // namespace ballbot
