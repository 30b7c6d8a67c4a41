#include "core/config_listing.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/key_unit.hpp"

namespace ballbot {
namespace {

/// Shortest text that a person would write: a scaled default is a round number again.
std::string numberText(double value) { return fmt::format("{:.12g}", value); }

std::string rangeText(const Range& r) {
  const bool low = std::isfinite(r.low), high = std::isfinite(r.high);
  if (low && r.low == kTiny) {
    return high ? fmt::format(", above 0, at most {:g}", r.high) : ", above 0";
  }
  if (low && high) return fmt::format(", {:g} to {:g}", r.low, r.high);
  if (low) return fmt::format(", at least {:g}", r.low);
  if (high) return fmt::format(", at most {:g}", r.high);
  return "";
}

double inOwnUnit(const std::string& key, SimDuration value) {
  const auto ns = static_cast<double>(value.count());
  const std::string unit = unitOfKey(key);
  return unit == "us" ? ns / 1e3 : unit == "ms" ? ns / 1e6 : ns / 1e9;
}

}  // namespace

std::string typeText(const KeyEntry& e) {
  switch (e.kind) {
    case KeyKind::kNumber:
      return "number" + rangeText(e.range);
    case KeyKind::kInteger:
      return "whole number" + rangeText(e.range);
    case KeyKind::kBoolean:
      return "true or false";
    case KeyKind::kText:
      return "text";
    case KeyKind::kDuration:
      return "time, whole nanoseconds" + rangeText(e.range);
    case KeyKind::kChoice:
      return fmt::format("one of {}", fmt::join(e.choices, ", "));
    case KeyKind::kNumbers:
      return fmt::format("list of {} numbers{}", e.count, rangeText(e.range));
    case KeyKind::kSection:
      return "mapping";
    case KeyKind::kList:
      return "list of mappings";
    case KeyKind::kOther:
      return e.other;
  }
  return "";
}

KeyEntry& ConfigListing::add(const ConfigKey& key, KeyKind kind, std::string fallback) {
  KeyEntry entry;
  entry.path = prefix_.empty() ? key.name : prefix_ + "." + key.name;
  entry.kind = kind;
  entry.required = key.required;
  entry.unit = unitOfKey(key.name);
  entry.fallback = std::move(fallback);
  entry.words = key.words;
  entries_.push_back(std::move(entry));
  return entries_.back();
}

void ConfigListing::number(const ConfigKey& key, double& value, Range range, double scale) {
  add(key, KeyKind::kNumber, numberText(value / scale)).range = range;
}

void ConfigListing::integer(const ConfigKey& key, int& value, Range range) {
  add(key, KeyKind::kInteger, fmt::format("{}", value)).range = range;
}

void ConfigListing::whole(const ConfigKey& key, std::int64_t& value, Range range) {
  add(key, KeyKind::kInteger, fmt::format("{}", value)).range = range;
}

void ConfigListing::boolean(const ConfigKey& key, bool& value) {
  add(key, KeyKind::kBoolean, value ? "true" : "false");
}

void ConfigListing::text(const ConfigKey& key, std::string& value) {
  add(key, KeyKind::kText, value);
}

void ConfigListing::duration(const ConfigKey& key, SimDuration& value, Range range) {
  add(key, KeyKind::kDuration, numberText(inOwnUnit(key.name, value))).range = range;
}

void ConfigListing::numbers(const ConfigKey& key, double* values, std::size_t count, Range range,
                            double scale) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) texts.push_back(numberText(values[i] / scale));
  KeyEntry& entry = add(key, KeyKind::kNumbers, fmt::format("[{}]", fmt::join(texts, ", ")));
  entry.range = range;
  entry.count = count;
}

void ConfigListing::section(const ConfigKey& key,
                            const std::function<void(ConfigVisitor&)>& inner) {
  add(key, KeyKind::kSection);
  enter(key.name, inner);
}

void ConfigListing::list(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) {
  add(key, KeyKind::kList);
  enter(std::string(key.name) + ".0", inner);
}

void ConfigListing::enter(const std::string& name,
                          const std::function<void(ConfigVisitor&)>& inner) {
  const std::string outer = prefix_;
  prefix_ = outer.empty() ? name : outer + "." + name;
  inner(*this);
  prefix_ = outer;
}

void ConfigListing::other(const ConfigKey& key, const char* kind,
                          const std::function<void(ConfigReader&)>&) {
  add(key, KeyKind::kOther).other = kind;
}

void ConfigListing::chooseIndex(const ConfigKey& key, std::size_t& index,
                                const std::vector<std::string>& names) {
  add(key, KeyKind::kChoice, names[index]).choices = names;
}

}  // namespace ballbot
