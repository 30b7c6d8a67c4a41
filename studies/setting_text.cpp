#include "studies/setting_text.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/yaml_text.hpp"

namespace ballbot {
std::string toFlowYaml(const ConfigNode& value) {
  std::string out;
  switch (value.kind()) {
    case ConfigNode::Kind::kNull:
      return "null";
    case ConfigNode::Kind::kScalar:
      return yamlText(value);
    case ConfigNode::Kind::kMap:
      for (const auto& [key, child] : value.entries()) {
        out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", yamlText(key), toFlowYaml(child));
      }
      return "{" + out + "}";
    case ConfigNode::Kind::kList:
      for (const ConfigNode& item : value.items())
        out += (out.empty() ? "" : ", ") + toFlowYaml(item);
      return "[" + out + "]";
  }
  return out;
}

std::string shellQuoted(const std::string& word) {
  const bool safe = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string("_-./=+:,@").find(c) != std::string::npos;
  });
  if (safe) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string commandLine(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + shellQuoted(word);
  return out;
}

}  // namespace ballbot
