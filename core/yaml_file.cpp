#include "core/yaml_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

SourceLocation locate(const std::string& source, const YAML::Mark& mark, bool has_lines) {
  if (!has_lines || mark.is_null()) return {source, 0, 0};
  return {source, mark.line + 1, mark.column + 1};
}

ConfigNode convert(const YAML::Node& node, const std::string& source, bool has_lines) {
  const SourceLocation where = locate(source, node.Mark(), has_lines);
  switch (node.Type()) {
    case YAML::NodeType::Undefined:
    case YAML::NodeType::Null: return ConfigNode::null(where);
    case YAML::NodeType::Scalar:
      // yaml-cpp gives the tag "!" to quoted scalars and "?" to plain ones.
      return ConfigNode::scalar(node.Scalar(), node.Tag() == "!", where);
    case YAML::NodeType::Sequence: {
      ConfigNode list = ConfigNode::list(where);
      for (const auto& item : node) list.append(convert(item, source, has_lines));
      return list;
    }
    case YAML::NodeType::Map: {
      ConfigNode map = ConfigNode::map(where);
      for (const auto& entry : node) {
        if (!entry.first.IsScalar()) {
          throw InputError(fmt::format("{}: a key must be a plain word",
                                       toText(locate(source, entry.first.Mark(), has_lines))));
        }
        const std::string& key = entry.first.Scalar();
        if (map.find(key)) {
          throw InputError(fmt::format("{}: key '{}' stands twice in this mapping; keep one",
                                       toText(locate(source, entry.first.Mark(), has_lines)), key));
        }
        ConfigNode value = convert(entry.second, source, has_lines);
        map.set(key, std::move(value));
      }
      return map;
    }
  }
  return ConfigNode::null(where);
}

ConfigNode parse(const std::string& text, const std::string& source, bool has_lines) {
  try {
    return convert(YAML::Load(text), source, has_lines);
  } catch (const YAML::Exception& e) {
    throw InputError(
        fmt::format("{}: not valid YAML: {}", toText(locate(source, e.mark, has_lines)), e.msg));
  }
}

ConfigNode load(const std::string& path, std::vector<std::string>& open_files);

ConfigNode expandIncludes(const ConfigNode& node, std::vector<std::string>& open_files) {
  if (node.kind() == ConfigNode::Kind::kList) {
    ConfigNode list = ConfigNode::list(node.where());
    for (const ConfigNode& item : node.items()) list.append(expandIncludes(item, open_files));
    return list;
  }
  if (node.kind() != ConfigNode::Kind::kMap) return node;

  ConfigNode own = ConfigNode::map(node.where());
  const ConfigNode* include = nullptr;
  for (const auto& [key, value] : node.entries()) {
    if (key == "include") {
      include = &value;
    } else {
      own.set(key, expandIncludes(value, open_files));
    }
  }
  if (!include) return own;
  if (include->kind() != ConfigNode::Kind::kScalar) {
    throw InputError(fmt::format("{}: 'include' must be a file name, not {}",
                                 toText(include->where()), include->kindName()));
  }
  const std::filesystem::path folder =
      std::filesystem::path(node.where().source).parent_path();
  const std::string file = (folder / include->text()).lexically_normal().string();
  if (!std::filesystem::is_regular_file(file)) {
    throw InputError(fmt::format("{}: cannot include '{}': no such file '{}'",
                                 toText(include->where()), include->text(), file));
  }
  return merged(load(file, open_files), own);
}

ConfigNode load(const std::string& path, std::vector<std::string>& open_files) {
  const std::string id = std::filesystem::weakly_canonical(path).string();
  if (std::find(open_files.begin(), open_files.end(), id) != open_files.end()) {
    throw InputError(fmt::format("{}: includes itself, by way of {} file(s)", path, open_files.size()));
  }
  std::ifstream in(path);
  if (!in) {
    throw InputError(fmt::format("{}: cannot be read. Does the file exist?", path));
  }
  std::ostringstream text;
  text << in.rdbuf();
  open_files.push_back(id);
  ConfigNode node = expandIncludes(parse(text.str(), path, true), open_files);
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

void applyOverride(ConfigNode& root, const std::string& path_equals_value) {
  const auto equals = path_equals_value.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(fmt::format("--set {}: write path=value, e.g. --set plant.seed=3",
                                 path_equals_value));
  }
  const std::string source = "--set " + path_equals_value;
  setPath(root, path_equals_value.substr(0, equals),
          parse(path_equals_value.substr(equals + 1), source, false));
}

}  // namespace ballbot
