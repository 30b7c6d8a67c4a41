#include "hil/eds/ini_text.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/printable_text.hpp"

namespace ballbot {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// Of a line, for a message.
std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 60;
  return printableText(std::string(text.substr(0, kMost))) + (text.size() > kMost ? "..." : "");
}

}  // namespace

std::string inSmallLetters(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

const IniText::Value* IniText::Section::find(const std::string& key) const {
  const auto it = values.find(key);
  return it == values.end() ? nullptr : &it->second;
}

const IniText::Section* IniText::find(const std::string& name) const {
  const auto it = sections_.find(name);
  return it == sections_.end() ? nullptr : &it->second;
}

IniText::IniText(std::string_view text, const std::string& file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.size() > kMostBytes) {
    throw InputError(
        fmt::format("{}: has {} bytes, at most {} are read", file, text.size(), kMostBytes));
  }
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    text.remove_prefix(kByteOrderMark.size());
  }
  Section* section = nullptr;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = text.find('\n');
    const std::string_view whole = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const auto refuse = [&](const std::string& what) {
      throw InputError(fmt::format("{}:{}: {}", file, number, what));
    };
    if (whole.size() > kLongestLine) refuse(fmt::format("a line of {} bytes", whole.size()));
    const std::string_view line = trimmed(whole);
    if (line.empty() || line[0] == ';' || line[0] == '#') continue;
    if (line[0] == '[') {
      if (line.back() != ']') refuse("'" + shown(line) + "' has no closing bracket");
      const std::string_view name = trimmed(line.substr(1, line.size() - 2));
      if (sections_.size() >= kMostSections) refuse("one section too many");
      const auto [it, is_new] = sections_.try_emplace(inSmallLetters(name));
      if (!is_new) {
        refuse(
            fmt::format("section [{}] is there already, at line {}", shown(name), it->second.line));
      }
      section = &it->second;
      section->name = std::string(name);
      section->line = number;
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      refuse("'" + shown(line) + "' is neither [section] nor key=value");
    }
    if (section == nullptr) refuse("'" + shown(line) + "' stands before the first [section]");
    const std::string_view key = trimmed(line.substr(0, equals));
    const auto [it, is_new] = section->values.try_emplace(
        inSmallLetters(key), Value{std::string(trimmed(line.substr(equals + 1))), number});
    if (!is_new) {
      refuse(fmt::format("{} is given already, at line {}", shown(key), it->second.line));
    }
  }
}

}  // namespace ballbot
