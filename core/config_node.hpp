#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ballbot {

/// Where a value was written: a file with line and column, or a command-line override.
struct SourceLocation {
  std::string source;  ///< file path as the user gave it, or e.g. "--set plant.seed=3"
  int line = 0;        ///< 1-based; 0 where the source has no lines
  int column = 0;      ///< 1-based; 0 where the source has no columns
};

/// "configs/robots/sea.yaml:14:3", or just the source where there are no lines.
std::string toText(const SourceLocation& where);

/// One node of a configuration tree. Every node remembers where it came from, so that an error in
/// a value can name the file, line and column even after includes and overrides were merged.
class ConfigNode {
 public:
  enum class Kind { kNull, kScalar, kMap, kList };
  using Entry = std::pair<std::string, ConfigNode>;

  static ConfigNode null(SourceLocation where);
  static ConfigNode scalar(std::string text, bool quoted, SourceLocation where);
  static ConfigNode map(SourceLocation where);
  static ConfigNode list(SourceLocation where);

  Kind kind() const { return kind_; }
  const char* kindName() const;
  const SourceLocation& where() const { return where_; }

  /// The text of a scalar; quoted scalars are always strings, e.g. "1" is not a number.
  const std::string& text() const { return text_; }
  bool quoted() const { return quoted_; }

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<ConfigNode>& items() const { return items_; }
  std::vector<ConfigNode>& items() { return items_; }

  /// The value of `key`, or null. Maps keep the order of the file.
  const ConfigNode* find(const std::string& key) const;
  ConfigNode* find(const std::string& key);
  void set(const std::string& key, ConfigNode value);
  void erase(const std::string& key);
  void append(ConfigNode value) { items_.push_back(std::move(value)); }

 private:
  Kind kind_ = Kind::kNull;
  SourceLocation where_;
  std::string text_;
  bool quoted_ = false;
  std::vector<Entry> entries_;
  std::vector<ConfigNode> items_;
};

/// `overlay` on top of `base`: maps merge key by key, null drops, anything else replaces.
ConfigNode merged(const ConfigNode& base, const ConfigNode& overlay);

/// Sets the value at a dotted path ("controller.mpc.horizon_s", "pushes.0.force_N"), creating maps
/// on the way; null takes the key away. Whether a key exists at all is judged by the tree's reader.
/// @throw InputError if the path runs through a scalar or past the end of a list.
void setPath(ConfigNode& root, const std::string& dotted_path, ConfigNode value);

/// The tree as YAML that reads back to the same tree. Equal trees give equal bytes, so this text
/// is also what a configuration digest is taken from.
std::string toYaml(const ConfigNode& root);

}  // namespace ballbot
