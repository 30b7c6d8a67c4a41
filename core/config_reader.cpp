#include "core/config_reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/nearest_word.hpp"
#include "core/number_text.hpp"

namespace ballbot {
namespace {

constexpr double kLongest_ns = 9.2e18;  // what a SimDuration can hold

std::optional<double> numberOf(const ConfigNode& node) {
  if (node.kind() != ConfigNode::Kind::kScalar || node.quoted()) return std::nullopt;
  return parseNumber(node.text());
}

std::string describe(const ConfigNode& node) {
  return node.kind() == ConfigNode::Kind::kScalar
             ? (node.quoted() ? fmt::format("\"{}\"", node.text()) : node.text())
             : node.kindName();
}

std::string describe(Range r) {
  const std::string low = r.low == kTiny ? "more than 0" : fmt::format("{}", r.low);
  if (r.low == kTiny && r.high == kInf) return "be more than 0";
  if (r.low == kTiny) return fmt::format("be {} and at most {}", low, r.high);
  if (r.high == kInf) return fmt::format("be at least {}", r.low);
  if (r.low == -kInf) return fmt::format("be at most {}", r.high);
  return fmt::format("be between {} and {}", r.low, r.high);
}

double checkedNumber(const ConfigNode& node, const std::string& name, Range range) {
  const std::optional<double> number = numberOf(node);
  if (!number) {
    throw InputError(
        fmt::format("{}: {} is {}, must be a number", toText(node.where()), name, describe(node)));
  }
  const double value = *number;
  if (std::isnan(value)) {
    throw InputError(fmt::format("{}: {} is not a number (NaN)", toText(node.where()), name));
  }
  if (std::isinf(value) || value < range.low || value > range.high) {
    const std::string expected = std::isinf(value) && range.low == -kInf && range.high == kInf
                                     ? "be finite"
                                     : describe(range);
    throw InputError(
        fmt::format("{}: {} is {}, must {}", toText(node.where()), name, node.text(), expected));
  }
  return value;
}

}  // namespace

ConfigReader::ConfigReader(const ConfigNode& node, std::string path)
    : node_(&node), path_(std::move(path)) {
  if (node.kind() != ConfigNode::Kind::kMap) {
    throw InputError(fmt::format("{}: {} must be a mapping of keys to values, not {}",
                                 toText(node.where()), path_.empty() ? "the file" : path_,
                                 describe(node)));
  }
}

bool ConfigReader::has(const std::string& key) const {
  const_cast<ConfigReader*>(this)->known_.insert(key);
  return node_->find(key) != nullptr;
}

const ConfigNode& ConfigReader::require(const std::string& key) {
  known_.insert(key);
  const ConfigNode* value = node_->find(key);
  if (value) return *value;
  // A misspelt key shows up as one that is missing and one that is unknown: say both.
  for (const auto& entry : node_->entries()) {
    if (known_.count(entry.first) == 0 && nearestWord(entry.first, {key}) == key) {
      throw InputError(fmt::format("{}: unknown key '{}'; did you mean '{}'?",
                                   toText(entry.second.where()), entry.first, key));
    }
  }
  throw InputError(fmt::format("{}: key '{}' is missing{}", toText(node_->where()), key,
                               path_.empty() ? "" : fmt::format(" in '{}'", path_)));
}

double ConfigReader::number(const std::string& key, Range range) {
  return checkedNumber(require(key), key, range);
}

double ConfigReader::numberOr(const std::string& key, double fallback, Range range) {
  return has(key) ? number(key, range) : fallback;
}

int ConfigReader::integer(const std::string& key, Range range) {
  range.low = std::max(range.low, -2147483648.0);
  range.high = std::min(range.high, 2147483647.0);
  const ConfigNode& node = require(key);
  const double value = checkedNumber(node, key, range);
  if (value != std::floor(value)) {
    throw InputError(fmt::format("{}: {} is {}, must be a whole number", toText(node.where()), key,
                                 node.text()));
  }
  return static_cast<int>(value);
}

int ConfigReader::integerOr(const std::string& key, int fallback, Range range) {
  return has(key) ? integer(key, range) : fallback;
}

bool ConfigReader::boolean(const std::string& key) {
  const ConfigNode& node = require(key);
  if (node.kind() == ConfigNode::Kind::kScalar && !node.quoted()) {
    if (node.text() == "true") return true;
    if (node.text() == "false") return false;
  }
  throw InputError(fmt::format("{}: {} is {}, must be true or false", toText(node.where()), key,
                               describe(node)));
}

bool ConfigReader::booleanOr(const std::string& key, bool fallback) {
  return has(key) ? boolean(key) : fallback;
}

std::string ConfigReader::text(const std::string& key) {
  const ConfigNode& node = require(key);
  if (node.kind() != ConfigNode::Kind::kScalar) {
    throw InputError(
        fmt::format("{}: {} must be text, not {}", toText(node.where()), key, describe(node)));
  }
  return node.text();
}

std::string ConfigReader::textOr(const std::string& key, std::string fallback) {
  return has(key) ? text(key) : std::move(fallback);
}

void ConfigReader::numbers(const std::string& key, double* out, std::size_t count, Range range) {
  const ConfigNode& node = require(key);
  if (node.kind() != ConfigNode::Kind::kList || node.items().size() != count) {
    const std::string got = node.kind() == ConfigNode::Kind::kList
                                ? fmt::format("{} values", node.items().size())
                                : describe(node);
    throw InputError(fmt::format("{}: {} has {}, must be a list of {} numbers",
                                 toText(node.where()), key, got, count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = checkedNumber(node.items()[i], fmt::format("{}[{}]", key, i), range);
  }
}

std::size_t ConfigReader::chooseIndex(const std::string& key,
                                      const std::vector<std::string>& names) {
  const std::string value = text(key);
  const auto it = std::find(names.begin(), names.end(), value);
  if (it == names.end()) {
    throw InputError(fmt::format("{}: {} is '{}', must be one of: {}", toText(require(key).where()),
                                 key, value, fmt::join(names, ", ")));
  }
  return static_cast<std::size_t>(it - names.begin());
}

SimDuration ConfigReader::duration(const std::string& key, Range range) {
  const auto endsWith = [&](const char* suffix) {
    const std::string s(suffix);
    return key.size() > s.size() && key.compare(key.size() - s.size(), s.size(), s) == 0;
  };
  const double ns_per_unit = endsWith("_us") ? 1e3 : endsWith("_ms") ? 1e6 : 1e9;
  const ConfigNode& node = require(key);
  const double ns = checkedNumber(node, key, range) * ns_per_unit;
  const double nearest = std::round(ns);
  if (std::abs(nearest) > kLongest_ns) {
    throw InputError(fmt::format("{}: {} is {}, must be at most 292 years", toText(node.where()),
                                 key, node.text()));
  }
  if (std::abs(ns - nearest) > 1e-3) {
    throw InputError(fmt::format(
        "{}: {} is {}, which is {} ns: not a whole number of nanoseconds. Write the period itself, "
        "not one over a frequency",
        toText(node.where()), key, node.text(), ns));
  }
  return SimDuration{static_cast<std::int64_t>(nearest)};
}

SimDuration ConfigReader::durationOr(const std::string& key, SimDuration fallback, Range range) {
  return has(key) ? duration(key, range) : fallback;
}

ConfigReader ConfigReader::child(const std::string& key) {
  return ConfigReader(require(key), path_.empty() ? key : path_ + "." + key);
}

std::vector<ConfigReader> ConfigReader::list(const std::string& key) {
  std::vector<ConfigReader> out;
  if (!has(key)) return out;
  const ConfigNode& node = require(key);
  if (node.kind() != ConfigNode::Kind::kList) {
    throw InputError(
        fmt::format("{}: {} must be a list, not {}", toText(node.where()), key, describe(node)));
  }
  for (std::size_t i = 0; i < node.items().size(); ++i) {
    out.emplace_back(node.items()[i],
                     fmt::format("{}{}.{}", path_.empty() ? "" : path_ + ".", key, i));
  }
  return out;
}

const ConfigNode* ConfigReader::raw(const std::string& key) {
  known_.insert(key);
  return node_->find(key);
}

void ConfigReader::finish() const {
  for (const auto& [key, value] : node_->entries()) {
    if (known_.count(key)) continue;
    const std::string guess = nearestWord(key, known_);
    throw InputError(fmt::format("{}: unknown key '{}'{}{}", toText(value.where()), key,
                                 path_.empty() ? "" : fmt::format(" in '{}'", path_),
                                 guess.empty()
                                     ? fmt::format("; known are: {}", fmt::join(known_, ", "))
                                     : fmt::format("; did you mean '{}'?", guess)));
  }
}

std::string ConfigReader::at(const std::string& key) const {
  const ConfigNode* value = node_->find(key);
  return fmt::format("{}: {}", toText(value ? value->where() : node_->where()), key);
}

}  // namespace ballbot
