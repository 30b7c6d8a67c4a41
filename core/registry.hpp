#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/config_visitor.hpp"

namespace ballbot {

/// Kinds of one thing, by name, of which a configuration chooses one: control laws, estimators. A
/// kind is a copyable struct with a `name`. Those of the program are there from the start; others
/// are added before the first scenario is read, and not while threads are at work.
template <typename Kind>
class Registry {
 public:
  explicit Registry(std::vector<Kind> kinds) : kinds_(std::move(kinds)) {}

  const std::vector<Kind>& all() const { return kinds_; }

  /// @throw std::invalid_argument if the name is taken.
  void add(Kind kind) {
    for (const Kind& other : kinds_) {
      if (other.name == kind.name)
        throw std::invalid_argument("there is a '" + kind.name + "' already");
    }
    kinds_.push_back(std::move(kind));
  }

  /// The kind that stands at a key; where a visitor does not read, the one named `usual`.
  /// @throw InputError naming those there are, by a reader.
  const Kind& choose(ConfigVisitor& v, const ConfigKey& key, const std::string& usual) const {
    std::vector<std::string> names;
    for (const Kind& kind : kinds_) names.push_back(kind.name);
    std::size_t index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), usual) - names.begin());
    v.chooseIndex(key, index, names);
    return kinds_.at(index);
  }

 private:
  std::vector<Kind> kinds_;
};

}  // namespace ballbot
