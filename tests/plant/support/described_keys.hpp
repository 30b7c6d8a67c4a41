#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/config_listing.hpp"
#include "core/config_node.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {

/// What `describe` tells of the mapping at `prefix`.
template <typename Describe>
std::vector<KeyEntry> described(const std::string& prefix, Describe&& describe) {
  ConfigListing listing(prefix);
  describe(listing);
  return listing.take();
}

/// Dotted paths of all keys below `node`, as a listing writes them.
inline void collectPaths(const ConfigNode& node, const std::string& path,
                         std::set<std::string>& out) {
  for (const auto& [key, value] : node.entries()) {
    const std::string below = path + "." + key;
    out.insert(below);
    collectPaths(value, below, out);
    for (const ConfigNode& item : value.items()) collectPaths(item, below + ".0", out);
  }
}

/// Keys of the mapping that no entry describes; empty where there is no such mapping.
inline std::vector<std::string> undescribed(const ConfigNode* node, const std::string& prefix,
                                            const std::vector<KeyEntry>& entries) {
  std::set<std::string> used, known;
  if (node) collectPaths(*node, prefix, used);
  for (const KeyEntry& entry : entries) known.insert(entry.path);
  std::vector<std::string> out;
  for (const std::string& path : used) {
    if (known.count(path) == 0) out.push_back(path);
  }
  return out;
}

/// The configurations that ship in a folder of configs/.
inline std::vector<std::string> shipped(const std::string& folder) {
  std::vector<std::string> out;
  for (const auto& entry :
       std::filesystem::directory_iterator(BALLBOT_SOURCE_DIR "/configs/" + folder)) {
    if (entry.path().extension() == ".yaml") out.push_back(entry.path().string());
  }
  return out;
}

/// Each key is told once and in words, and has a default where it may be left out.
inline void expectWellDescribed(const std::vector<KeyEntry>& entries) {
  std::set<std::string> seen;
  for (const KeyEntry& e : entries) {
    EXPECT_TRUE(seen.insert(e.path).second) << e.path << " is told twice";
    EXPECT_GE(e.words.size(), 8U) << e.path;
    EXPECT_NE(e.words.back(), '.') << e.path;
    const bool plain =
        e.kind != KeyKind::kSection && e.kind != KeyKind::kList && e.kind != KeyKind::kOther;
    if (plain && !e.required) {
      EXPECT_FALSE(e.fallback.empty()) << e.path;
    }
    if (e.kind == KeyKind::kOther) {
      EXPECT_GE(e.other.size(), 8U) << e.path;
    }
  }
}

}  // namespace ballbot
