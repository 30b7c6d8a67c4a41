#include "core/config_node.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/yaml_text.hpp"

namespace ballbot {

std::string toText(const SourceLocation& where) {
  if (where.line == 0) return where.source;
  return fmt::format("{}:{}:{}", where.source, where.line, where.column);
}

ConfigNode ConfigNode::null(SourceLocation where) {
  ConfigNode n;
  n.where_ = std::move(where);
  return n;
}

ConfigNode ConfigNode::scalar(std::string text, bool quoted, SourceLocation where) {
  ConfigNode n = null(std::move(where));
  n.kind_ = Kind::kScalar;
  n.text_ = std::move(text);
  n.quoted_ = quoted;
  return n;
}

ConfigNode ConfigNode::map(SourceLocation where) {
  ConfigNode n = null(std::move(where));
  n.kind_ = Kind::kMap;
  return n;
}

ConfigNode ConfigNode::list(SourceLocation where) {
  ConfigNode n = null(std::move(where));
  n.kind_ = Kind::kList;
  return n;
}

const char* ConfigNode::kindName() const {
  switch (kind_) {
    case Kind::kNull:
      return "nothing";
    case Kind::kScalar:
      return "a value";
    case Kind::kMap:
      return "a mapping";
    case Kind::kList:
      return "a list";
  }
  return "?";
}

const ConfigNode* ConfigNode::find(const std::string& key) const {
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&](const Entry& e) { return e.first == key; });
  return it == entries_.end() ? nullptr : &it->second;
}

ConfigNode* ConfigNode::find(const std::string& key) {
  return const_cast<ConfigNode*>(static_cast<const ConfigNode*>(this)->find(key));
}

void ConfigNode::set(const std::string& key, ConfigNode value) {
  if (ConfigNode* old = find(key)) {
    *old = std::move(value);
  } else {
    entries_.emplace_back(key, std::move(value));
  }
}

void ConfigNode::erase(const std::string& key) {
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(),
                                [&](const Entry& e) { return e.first == key; }),
                 entries_.end());
}

ConfigNode merged(const ConfigNode& base, const ConfigNode& overlay) {
  if (base.kind() != ConfigNode::Kind::kMap || overlay.kind() != ConfigNode::Kind::kMap) {
    return overlay;
  }
  ConfigNode result = base;
  for (const auto& [key, value] : overlay.entries()) {
    const ConfigNode* old = result.find(key);
    if (value.kind() == ConfigNode::Kind::kNull) {
      result.erase(key);
    } else {
      result.set(key, old ? merged(*old, value) : value);
    }
  }
  return result;
}

void setPath(ConfigNode& root, const std::string& dotted_path, ConfigNode value) {
  ConfigNode* node = &root;
  std::string::size_type begin = 0;
  while (true) {
    const auto dot = dotted_path.find('.', begin);
    const std::string key = dotted_path.substr(begin, dot - begin);
    const bool last = dot == std::string::npos;
    if (key.empty()) {
      throw InputError(fmt::format("{}: '{}' has an empty name in it; write a.b.c",
                                   toText(value.where()), dotted_path));
    }
    if (node->kind() == ConfigNode::Kind::kList) {
      const bool number =
          std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
      const auto i = static_cast<std::size_t>(number ? parseWhole(key).value_or(-1) : -1);
      if (i >= node->items().size()) {
        throw InputError(fmt::format("{}: '{}' is not an item of the list at {}, which has {}",
                                     toText(value.where()), key, toText(node->where()),
                                     node->items().size()));
      }
      node = &node->items()[i];
    } else if (node->kind() == ConfigNode::Kind::kMap) {
      if (last && value.kind() == ConfigNode::Kind::kNull) {
        node->erase(key);
        return;
      }
      if (!node->find(key)) node->set(key, ConfigNode::map(value.where()));
      node = node->find(key);
    } else {
      throw InputError(fmt::format("{}: '{}' cannot be set below {}, which is {}",
                                   toText(value.where()), dotted_path, toText(node->where()),
                                   node->kindName()));
    }
    if (last) break;
    begin = dot + 1;
  }
  *node = std::move(value);
}

namespace {

void emit(const ConfigNode& node, int indent, std::string& out) {
  const std::string pad(static_cast<std::size_t>(indent), ' ');
  switch (node.kind()) {
    case ConfigNode::Kind::kNull:
      out += "null\n";
      return;
    case ConfigNode::Kind::kScalar:
      out += yamlText(node) + "\n";
      return;
    case ConfigNode::Kind::kMap:
      if (node.entries().empty()) {
        out += "{}\n";
        return;
      }
      if (indent > 0) out += "\n";
      for (const auto& [key, value] : node.entries()) {
        out += pad + yamlText(key) + ": ";
        emit(value, indent + 2, out);
      }
      return;
    case ConfigNode::Kind::kList:
      if (node.items().empty()) {
        out += "[]\n";
        return;
      }
      const bool flat =
          std::all_of(node.items().begin(), node.items().end(),
                      [](const ConfigNode& n) { return n.kind() == ConfigNode::Kind::kScalar; });
      if (flat) {
        out += "[";
        for (std::size_t i = 0; i < node.items().size(); ++i) {
          out += i ? ", " : "";
          out += yamlText(node.items()[i]);
        }
        out += "]\n";
        return;
      }
      out += "\n";
      for (const ConfigNode& item : node.items()) {
        out += pad + "- ";
        emit(item, indent + 2, out);
      }
      return;
  }
}

}  // namespace

std::string toYaml(const ConfigNode& root) {
  std::string out;
  emit(root, 0, out);
  return out;
}

}  // namespace ballbot
