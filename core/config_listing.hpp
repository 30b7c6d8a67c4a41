#pragma once

#include <string>
#include <vector>

#include "core/config_visitor.hpp"

namespace ballbot {

enum class KeyKind {
  kNumber,
  kInteger,
  kBoolean,
  kText,
  kDuration,
  kChoice,
  kNumbers,
  kSection,
  kList,
  kOther
};

/// One key of a configuration as it is described.
struct KeyEntry {
  std::string path;  ///< dotted; `.0.` stands for any item of a list
  KeyKind kind = KeyKind::kNumber;
  bool required = false;
  std::string unit;       ///< by the key's name; empty where it has none
  Range range;            ///< of numbers
  std::size_t count = 1;  ///< of kNumbers
  std::string fallback;  ///< as YAML; empty where there is none. Of a required key: what the struct
                         ///< begins with
  std::vector<std::string> choices;  ///< of kChoice
  std::string other;                 ///< of kOther: what it is
  std::string words;
};

/// What stands behind the name: "number, above 0", "one of full, reduced_wheels".
std::string typeText(const KeyEntry& entry);

/// Lists what is described, in the order in which it is told.
class ConfigListing final : public ConfigVisitor {
 public:
  /// @param prefix  dotted path of the described mapping
  explicit ConfigListing(std::string prefix = "") : prefix_(std::move(prefix)) {}

  std::vector<KeyEntry> take() { return std::move(entries_); }

  Range depending(Range) const override { return {}; }
  void number(const ConfigKey& key, double& value, Range range, double scale) override;
  void integer(const ConfigKey& key, int& value, Range range) override;
  void whole(const ConfigKey& key, std::int64_t& value, Range range) override;
  void boolean(const ConfigKey& key, bool& value) override;
  void text(const ConfigKey& key, std::string& value) override;
  void fileName(const ConfigKey& key, std::string& value) override { text(key, value); }
  void duration(const ConfigKey& key, SimDuration& value, Range range) override;
  void numbers(const ConfigKey& key, double* values, std::size_t count, Range range,
               double scale) override;
  void section(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) override;
  void list(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) override;
  void other(const ConfigKey& key, const char* kind,
             const std::function<void(ConfigReader&)>& read) override;
  void chooseIndex(const ConfigKey& key, std::size_t& index,
                   const std::vector<std::string>& names) override;

 private:
  KeyEntry& add(const ConfigKey& key, KeyKind kind, std::string fallback = "");
  void enter(const std::string& name, const std::function<void(ConfigVisitor&)>& inner);

  std::string prefix_;
  std::vector<KeyEntry> entries_;
};

}  // namespace ballbot
