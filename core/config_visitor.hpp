#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "core/config_reader.hpp"

namespace ballbot {

/// A key of a mapping, and what it is for: one line, without its unit, which the key's name says.
struct ConfigKey {
  const char* name;
  const char* words;
  bool required = false;
};
constexpr ConfigKey must(const char* name, const char* words) { return {name, words, true}; }
/// What is absent keeps the value it had.
constexpr ConfigKey may(const char* name, const char* words) { return {name, words, false}; }

/// What a configuration struct tells about itself, once: its method describe(ConfigVisitor&) names
/// every key with its member, range and words. Reading a file, writing values back, the reference
/// in docs/, the JSON schema, `ballbot explain` and parameters of the FMU all come from that.
///
///     void describe(ConfigVisitor& v) {
///       v.number(must("radius_m", "of the ball"), radius, {kTiny, kInf});
///       v.number(may("zenith_deg", "of each wheel's contact"), zenith, {1, 89}, kRadPerDeg);
///     }
class ConfigVisitor {
 public:
  virtual ~ConfigVisitor() = default;

  /// @param scale  the member is scale times what stands in the file, in whose unit `range` is
  virtual void number(const ConfigKey& key, double& value, Range range = {}, double scale = 1) = 0;
  virtual void integer(const ConfigKey& key, int& value, Range range = {}) = 0;
  /// One too large for an int, such as a seed: up to kLargestWhole to either side.
  virtual void whole(const ConfigKey& key, std::int64_t& value, Range range = {}) = 0;
  virtual void boolean(const ConfigKey& key, bool& value) = 0;
  virtual void text(const ConfigKey& key, std::string& value) = 0;
  /// Text that can name a file or a folder, and no path that leads elsewhere.
  virtual void fileName(const ConfigKey& key, std::string& value) = 0;
  /// The key ends in _s, _ms or _us.
  virtual void duration(const ConfigKey& key, SimDuration& value, Range range = {}) = 0;
  /// A list of exactly `count` numbers.
  virtual void numbers(const ConfigKey& key, double* values, std::size_t count, Range range = {},
                       double scale = 1) = 0;
  /// A mapping below this one. One that may be absent is described all the same; a reader enters
  /// it only where it is there.
  virtual void section(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) = 0;
  /// A list of mappings. `inner` describes one; a reader calls it for each.
  virtual void list(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) = 0;
  /// What no plain value is, e.g. a signal over time: `kind` names it for people, `read` reads it
  /// where it is there.
  virtual void other(const ConfigKey& key, const char* kind,
                     const std::function<void(ConfigReader&)>& read) = 0;

  /// Relations between values that were told before: a reader calls it, to throw what is wrong with
  /// the place of a key (ConfigReader::at).
  virtual void check(const std::function<void(const ConfigReader&)>& relation) { (void)relation; }

  /// A range that another value decides: a reader holds to it, a list does not know it.
  virtual Range depending(Range range) const { return range; }

  template <typename Vector>
  void vector(const ConfigKey& key, Vector& value, Range range = {}, double scale = 1) {
    numbers(key, value.data(), static_cast<std::size_t>(value.size()), range, scale);
  }
  /// One of the named values; an error lists them.
  template <typename Value>
  void choice(const ConfigKey& key, Value& value,
              std::initializer_list<std::pair<const char*, Value>> choices) {
    std::vector<std::string> names;
    std::size_t index = 0;
    for (const auto& c : choices) {
      if (c.second == value) index = names.size();
      names.emplace_back(c.first);
    }
    chooseIndex(key, index, names);
    value = (choices.begin() + index)->second;
  }
  /// The same where the names are known at run time only.
  virtual void chooseIndex(const ConfigKey& key, std::size_t& index,
                           const std::vector<std::string>& names) = 0;
};

/// Reads what is described from a mapping. finish() stays the caller's, who may read more.
class ConfigReading final : public ConfigVisitor {
 public:
  explicit ConfigReading(ConfigReader& in) : in_(in) {}

  void number(const ConfigKey& key, double& value, Range range, double scale) override;
  void integer(const ConfigKey& key, int& value, Range range) override;
  void whole(const ConfigKey& key, std::int64_t& value, Range range) override;
  void boolean(const ConfigKey& key, bool& value) override;
  void text(const ConfigKey& key, std::string& value) override;
  void fileName(const ConfigKey& key, std::string& value) override;
  void duration(const ConfigKey& key, SimDuration& value, Range range) override;
  void numbers(const ConfigKey& key, double* values, std::size_t count, Range range,
               double scale) override;
  void section(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) override;
  void list(const ConfigKey& key, const std::function<void(ConfigVisitor&)>& inner) override;
  void other(const ConfigKey& key, const char* kind,
             const std::function<void(ConfigReader&)>& read) override;
  void check(const std::function<void(const ConfigReader&)>& relation) override { relation(in_); }
  void chooseIndex(const ConfigKey& key, std::size_t& index,
                   const std::vector<std::string>& names) override;

 private:
  bool absent(const ConfigKey& key) const { return !key.required && !in_.has(key.name); }
  ConfigReader& in_;
};

/// @throw InputError as ConfigReader.
template <typename Described>
void readDescribed(ConfigReader& in, Described& out) {
  ConfigReading reading(in);
  out.describe(reading);
}

}  // namespace ballbot
