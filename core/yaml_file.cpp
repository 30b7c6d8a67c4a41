#include "core/yaml_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kLargestFile = std::size_t{16} << 20;

SourceLocation locate(const std::string& source, const YAML::Mark& mark, bool has_lines) {
  if (!has_lines || mark.is_null()) return {source, 0, 0};
  return {source, mark.line + 1, mark.column + 1};
}

/// Builds the tree from the parser's events rather than from its own tree, which knows no longer
/// what was written: aliases, tags and further documents are gone there.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& source, bool has_lines)
      : source_(source), has_lines_(has_lines), root_(ConfigNode::null({source, 0, 0})) {}

  ConfigNode takeRoot() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) refuse(mark, "a second document begins here ('---'); keep one");
    root_ = ConfigNode::null(at(mark));
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    checkPlain(mark, anchor, "");
    if (atKey()) refuse(mark, "a key must be a plain word");
    add(ConfigNode::null(at(mark)));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(mark, "an alias ('*name') is not read; write the value, or include a file");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    checkPlain(mark, anchor, tag);
    if (atKey()) {
      // In quotes it is a word like any other.
      if (value == "<<" && tag != "!")
        refuse(mark, "a merge key ('<<') is not read; write include: FILE");
      takeKey(mark, value);
    } else {
      // yaml-cpp gives the tag "!" to quoted scalars and "?" to plain ones.
      add(ConfigNode::scalar(value, tag == "!", at(mark)));
    }
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(mark, tag, anchor, ConfigNode::list(at(mark)));
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(mark, tag, anchor, ConfigNode::map(at(mark)));
  }
  void OnMapEnd() override { end(); }

 private:
  /// A mapping or list that is not complete yet, and the key that waits for its value.
  struct Open {
    ConfigNode node;
    std::optional<std::string> key;
  };

  SourceLocation at(const YAML::Mark& mark) const { return locate(source_, mark, has_lines_); }
  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& why) const {
    throw InputError(fmt::format("{}: {}", toText(at(mark)), why));
  }
  void checkPlain(const YAML::Mark& mark, YAML::anchor_t anchor, const std::string& tag) const {
    if (anchor != YAML::NullAnchor) refuse(mark, "an anchor ('&name') is not read; take it away");
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse(mark, fmt::format("a tag ('{}') is not read; take it away", tag));
    }
  }
  bool atKey() const {
    return !open_.empty() && open_.back().node.kind() == ConfigNode::Kind::kMap &&
           !open_.back().key;
  }
  void takeKey(const YAML::Mark& mark, const std::string& key) {
    if (open_.back().node.find(key)) {
      refuse(mark, fmt::format("key '{}' stands twice in this mapping; keep one", key));
    }
    open_.back().key = key;
  }
  void begin(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
             ConfigNode node) {
    checkPlain(mark, anchor, tag);
    if (atKey()) refuse(mark, "a key must be a plain word");
    open_.push_back({std::move(node), std::nullopt});
  }
  void end() {
    ConfigNode complete = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(complete));
  }
  void add(ConfigNode value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (Open& parent = open_.back(); parent.key) {
      parent.node.set(*parent.key, std::move(value));
      parent.key.reset();
    } else {
      parent.node.append(std::move(value));
    }
  }

  const std::string& source_;
  bool has_lines_;
  int documents_ = 0;
  ConfigNode root_;
  std::vector<Open> open_;
};

ConfigNode parse(const std::string& text, const std::string& source, bool has_lines) {
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    TreeBuilder tree(source, has_lines);
    while (parser.HandleNextDocument(tree)) {
    }
    return tree.takeRoot();
  } catch (const YAML::Exception& e) {
    throw InputError(
        fmt::format("{}: not valid YAML: {}", toText(locate(source, e.mark, has_lines)), e.msg));
  }
}

ConfigNode load(const std::string& path, std::vector<std::string>& open_files);

/// What a mapping starts from. `folder` is where the file that says so lies.
ConfigNode included(const ConfigNode& include, const std::filesystem::path& folder,
                    std::vector<std::string>& open_files) {
  if (include.kind() != ConfigNode::Kind::kScalar) {
    throw InputError(fmt::format("{}: 'include' must be a file name, not {}",
                                 toText(include.where()), include.kindName()));
  }
  const std::string file = (folder / include.text()).lexically_normal().string();
  if (!std::filesystem::is_regular_file(file)) {
    throw InputError(fmt::format("{}: cannot include '{}': no such file '{}'",
                                 toText(include.where()), include.text(), file));
  }
  ConfigNode node = load(file, open_files);
  if (node.kind() != ConfigNode::Kind::kMap) {
    throw InputError(
        fmt::format("{}: an included file must be a mapping of keys to values, not {}; "
                    "it is included at {}",
                    toText(node.where()), node.kindName(), toText(include.where())));
  }
  return node;
}

ConfigNode expandIncludes(const ConfigNode& node, const std::filesystem::path& folder,
                          std::vector<std::string>& open_files) {
  if (node.kind() == ConfigNode::Kind::kList) {
    ConfigNode list = ConfigNode::list(node.where());
    for (const ConfigNode& item : node.items()) {
      list.append(expandIncludes(item, folder, open_files));
    }
    return list;
  }
  if (node.kind() != ConfigNode::Kind::kMap) return node;

  ConfigNode own = ConfigNode::map(node.where());
  for (const auto& [key, value] : node.entries()) {
    if (key != "include") own.set(key, expandIncludes(value, folder, open_files));
  }
  const ConfigNode* include = node.find("include");
  return include ? merged(included(*include, folder, open_files), own) : own;
}

ConfigNode load(const std::string& path, std::vector<std::string>& open_files) {
  const std::string id = std::filesystem::weakly_canonical(path).string();
  if (std::find(open_files.begin(), open_files.end(), id) != open_files.end()) {
    throw InputError(
        fmt::format("{}: includes itself, by way of {} file(s)", path, open_files.size()));
  }
  std::ifstream in(path);
  if (!in) {
    throw InputError(fmt::format("{}: cannot be read. Does the file exist?", path));
  }
  // A device may give bytes for ever.
  std::string text(kLargestFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kLargestFile) {
    throw InputError(fmt::format("{}: is longer than {} MiB, which no configuration is", path,
                                 kLargestFile >> 20));
  }
  open_files.push_back(id);
  ConfigNode node = expandIncludes(parse(text, path, true),
                                   std::filesystem::path(path).parent_path(), open_files);
  open_files.pop_back();
  return node;
}

}  // namespace

ConfigNode loadYamlFile(const std::string& path) {
  std::vector<std::string> open_files;
  return load(path, open_files);
}

ConfigNode parseYaml(const std::string& text, const std::string& source) {
  return parse(text, source, true);
}

std::pair<std::string, ConfigNode> readOverride(const std::string& path_equals_value) {
  const auto equals = path_equals_value.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(
        fmt::format("--set {}: write path=value, e.g. --set duration_s=5", path_equals_value));
  }
  const std::string source = "--set " + path_equals_value;
  const std::string path = path_equals_value.substr(0, equals);
  const std::string last = path.substr(path.rfind('.') + 1);
  if (last == "include") {
    throw InputError(
        fmt::format("{}: to set all of a mapping from a file write e.g. --set "
                    "'controller={{include: FILE}}'",
                    source));
  }
  std::vector<std::string> open_files;
  return {path, expandIncludes(parse(path_equals_value.substr(equals + 1), source, false), "",
                               open_files)};
}

void applyOverride(ConfigNode& root, const std::string& path_equals_value) {
  auto [path, value] = readOverride(path_equals_value);
  setPath(root, path, std::move(value));
}

}  // namespace ballbot
