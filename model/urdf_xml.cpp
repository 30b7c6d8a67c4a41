#include "model/urdf_xml.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include "core/error.hpp"
#include "core/nearest_word.hpp"

namespace ballbot {
namespace {

constexpr const char* kXacroHint =
    "this is xacro, not yet a URDF; expand it: xacro robot.urdf.xacro > robot.urdf";

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// "mismatched element in <link>" for XML_ERROR_MISMATCHED_ELEMENT and the detail beside it.
std::string inWords(const tinyxml2::XMLDocument& document) {
  std::string name = document.ErrorName();
  for (const char* prefix : {"XML_ERROR_", "XML_"}) {
    if (name.rfind(prefix, 0) == 0) name.erase(0, std::strlen(prefix));
  }
  for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(c));
  const std::string whole = document.ErrorStr(), mark = "XMLElement name=";
  const std::size_t at = whole.find(mark);
  return at == std::string::npos ? name
                                 : fmt::format("{} in <{}>", name, whole.substr(at + mark.size()));
}

/// " of link 'arm_2'", from the element itself or the nearest one around it that has a name.
std::string ownerOf(const tinyxml2::XMLElement* element) {
  for (const auto* e = element; e != nullptr;
       e = e->Parent() ? e->Parent()->ToElement() : nullptr) {
    const bool owner = std::strcmp(e->Name(), "link") == 0 || std::strcmp(e->Name(), "joint") == 0;
    const char* name = e->Attribute("name");
    if (!owner || !name) continue;
    return e == element ? fmt::format(" '{}'", name) : fmt::format(" of {} '{}'", e->Name(), name);
  }
  return "";
}

/// Not strtod: it obeys the locale of the process, and an FMU lives in other people's processes.
bool parseNumber(const std::string& word, double& value) {
  const char* begin = word.data();
  const char* end = begin + word.size();
  if (word.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
  const auto [stopped, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stopped == end;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  for (auto at = text.begin(); at != text.end();) {
    at = std::find_if_not(at, text.end(), isSpace);
    const auto end = std::find_if(at, text.end(), isSpace);
    if (at != end) words.emplace_back(at, end);
    at = end;
  }
  return words;
}

}  // namespace

std::string UrdfElement::tag() const { return element_->Name(); }

int UrdfElement::line() const { return element_->GetLineNum(); }

std::optional<UrdfElement> UrdfElement::child(const char* tag) const {
  const auto* found = element_->FirstChildElement(tag);
  if (!found) return std::nullopt;
  if (const auto* second = found->NextSiblingElement(tag)) {
    UrdfElement(second, file_).fail("is there twice, must be there once");
  }
  return UrdfElement(found, file_);
}

UrdfElement UrdfElement::requiredChild(const char* tag) const {
  const auto found = child(tag);
  if (!found) fail(fmt::format("has no <{}>", tag));
  return *found;
}

std::vector<UrdfElement> UrdfElement::children() const {
  std::vector<UrdfElement> out;
  for (const auto* e = element_->FirstChildElement(); e; e = e->NextSiblingElement()) {
    out.emplace_back(e, file_);
  }
  return out;
}

std::string UrdfElement::text(const char* attribute) const {
  const char* value = element_->Attribute(attribute);
  if (!value || !*value) fail(fmt::format("has no {}", attribute));
  return value;
}

double UrdfElement::number(const char* attribute) const {
  const auto value = numberIfAny(attribute);
  if (!value) fail(fmt::format("has no {}", attribute));
  return *value;
}

std::optional<double> UrdfElement::numberIfAny(const char* attribute) const {
  const auto value = limitIfAny(attribute);
  if (value && std::isinf(*value)) failNumber(attribute, 1);
  return value;
}

std::optional<double> UrdfElement::limitIfAny(const char* attribute) const {
  if (!element_->Attribute(attribute)) return std::nullopt;
  return numbers(attribute, 1)[0];
}

Vector3 UrdfElement::vectorOr(const char* attribute, const Vector3& fallback) const {
  if (!element_->Attribute(attribute)) return fallback;
  const std::vector<double> v = numbers(attribute, 3);
  const Vector3 vector(v[0], v[1], v[2]);
  if (!vector.allFinite()) failNumber(attribute, 3);
  return vector;
}

std::vector<double> UrdfElement::numbers(const char* attribute, std::size_t count) const {
  std::vector<double> out;
  for (const std::string& word : wordsOf(element_->Attribute(attribute))) {
    double value = 0;
    if (!parseNumber(word, value) || std::isnan(value)) failNumber(attribute, count);
    out.push_back(value);
  }
  if (out.size() != count) failNumber(attribute, count);
  return out;
}

void UrdfElement::failNumber(const char* attribute, std::size_t count) const {
  const std::string value = element_->Attribute(attribute);
  std::string hint;
  if (value.find("${") != std::string::npos) {
    hint = fmt::format(": {}", kXacroHint);
  } else if (value.find(',') != std::string::npos) {
    hint = ", with decimal points and without commas";
  }
  fail(fmt::format("{} is \"{}\", must be {}{}", attribute, value,
                   count == 1 ? "a number" : fmt::format("{} numbers", count), hint));
}

void UrdfElement::onlyAttributes(std::initializer_list<const char*> known) const {
  const std::set<std::string> names(known.begin(), known.end());
  for (const auto* a = element_->FirstAttribute(); a; a = a->Next()) {
    if (names.count(a->Name())) continue;
    const std::string meant = nearestWord(a->Name(), names);
    fail(fmt::format("{} would be ignored; {}", a->Name(),
                     meant.empty() ? fmt::format("known here: {}", fmt::join(names, ", "))
                                   : fmt::format("did you mean {}?", meant)));
  }
}

void UrdfElement::noMisspeltChildren(std::initializer_list<const char*> known) const {
  const std::set<std::string> names(known.begin(), known.end());
  for (const UrdfElement& e : children()) {
    if (e.tag().rfind("xacro:", 0) == 0) e.fail(kXacroHint);
    if (names.count(e.tag())) continue;
    const std::string meant = nearestWord(e.tag(), names);
    if (!meant.empty()) e.fail(fmt::format("would be ignored; did you mean <{}>?", meant));
  }
}

void UrdfElement::fail(const std::string& what) const {
  throw InputError(
      fmt::format("{}:{}: <{}>{}: {}", *file_, line(), tag(), ownerOf(element_), what));
}

UrdfXml::UrdfXml(std::string file, const std::string& text)
    : file_(std::move(file)), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  if (document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(fmt::format("{}:{}: is not well-formed XML: {}", file_,
                                 std::max(1, document_->ErrorLineNum()), inWords(*document_)));
  }
  const auto* root = document_->RootElement();
  if (!root || std::strcmp(root->Name(), "robot") != 0) {
    throw InputError(fmt::format("{}:{}: is no URDF: its root is {}, must be <robot>", file_,
                                 root ? root->GetLineNum() : 1,
                                 root ? fmt::format("<{}>", root->Name()) : "missing"));
  }
}

UrdfXml::~UrdfXml() = default;

UrdfElement UrdfXml::robot() const { return {document_->RootElement(), &file_}; }

}  // namespace ballbot
