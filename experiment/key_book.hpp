#pragma once

#include <string>
#include <vector>

#include "core/config_listing.hpp"

namespace ballbot {

/// Every key that files of one kind may hold, in the order in which it is told.
struct KeyBook {
  std::string kind;  ///< "scenario"
  std::vector<KeyEntry> keys;

  /// A key and, of a mapping, those below it; a number in the path stands for any item of a list.
  /// @throw InputError if there is no such key, naming the nearest.
  std::vector<KeyEntry> at(const std::string& path) const;

  /// JSON Schema (draft 2020-12) of such files, with which editors complete and check. It demands
  /// no key, since a file may take any from one that it includes.
  std::string schema() const;
};

}  // namespace ballbot
