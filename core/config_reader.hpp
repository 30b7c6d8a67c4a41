#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/config_node.hpp"
#include "core/time.hpp"

namespace ballbot {

/// Closed interval a number must lie in.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

constexpr double kInf = std::numeric_limits<double>::infinity();
/// Smallest value for keys that must be positive; zero itself is refused.
constexpr double kTiny = std::numeric_limits<double>::min();

/// Strict reader of one mapping: every key must be read, every value has a type and a range.
///
///     ConfigReader in(tree);
///     p.spring_stiffness_Nm_per_rad = in.number("spring_stiffness_Nm_per_rad", {1.0, 1e6});
///     in.finish();   // names any key nobody read, and its nearest neighbour
///
/// Methods without a default demand the key; the `...Or` forms take the value given when it is
/// absent. All throw InputError with file:line:column, what came and what was expected.
class ConfigReader {
 public:
  /// @param path dotted path of `node` in the whole tree, for messages; empty at the root.
  /// The node must outlive the reader.
  explicit ConfigReader(const ConfigNode& node, std::string path = "");

  bool has(const std::string& key) const;
  double number(const std::string& key, Range range = {});
  double numberOr(const std::string& key, double fallback, Range range = {});
  int integer(const std::string& key, Range range = {});
  int integerOr(const std::string& key, int fallback, Range range = {});
  bool boolean(const std::string& key);
  bool booleanOr(const std::string& key, bool fallback);
  std::string text(const std::string& key);
  std::string textOr(const std::string& key, std::string fallback);

  /// Exactly N numbers, each within `range`.
  template <std::size_t N>
  std::array<double, N> numbers(const std::string& key, Range range = {}) {
    std::array<double, N> out;
    numbers(key, out.data(), N, range);
    return out;
  }
  void numbers(const std::string& key, double* out, std::size_t count, Range range);
  template <std::size_t N>
  std::array<double, N> numbersOr(const std::string& key, const std::array<double, N>& fallback,
                                  Range range = {}) {
    return has(key) ? numbers<N>(key, range) : fallback;
  }

  /// One of the named choices; the error lists them.
  template <typename Enum>
  Enum choice(const std::string& key, std::initializer_list<std::pair<const char*, Enum>> choices) {
    std::vector<std::string> names;
    for (const auto& c : choices) names.emplace_back(c.first);
    return (choices.begin() + chooseIndex(key, names))->second;
  }
  template <typename Enum>
  Enum choiceOr(const std::string& key, Enum fallback,
                std::initializer_list<std::pair<const char*, Enum>> choices) {
    return has(key) ? choice<Enum>(key, choices) : fallback;
  }

  std::size_t chooseIndex(const std::string& key, const std::vector<std::string>& names);

  /// A period or length of time written in the key's own unit: the key must end in _s, _ms or _us.
  /// It must be a whole number of nanoseconds.
  SimDuration duration(const std::string& key, Range range = {});
  SimDuration durationOr(const std::string& key, SimDuration fallback, Range range = {});

  /// A mapping below this one; the caller reads and finishes it.
  ConfigReader child(const std::string& key);
  /// A list of mappings; absent counts as empty.
  std::vector<ConfigReader> list(const std::string& key);
  /// The raw node, marked as read; null where absent.
  const ConfigNode* raw(const std::string& key);

  /// @throw InputError naming the first key nobody read.
  void finish() const;

  /// "file:line:col: path.key " for messages about relations between values.
  std::string at(const std::string& key) const;
  const std::string& path() const { return path_; }

 private:
  const ConfigNode& require(const std::string& key);

  const ConfigNode* node_;
  std::string path_;
  std::set<std::string> known_;
};

}  // namespace ballbot
