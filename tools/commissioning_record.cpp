#include "tools/commissioning_record.hpp"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "experiment/sealed_json.hpp"

namespace ballbot {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kFormat = "ballbot commissioning record 1";
const std::set<std::string> kOfNoMatter{"emulator", "scenario", "set", "realtime"};

void flatten(const ConfigNode& node, const std::string& path, Pairs& out) {
  const std::string inner = path.empty() ? "" : path + ".";
  if (node.kind() == ConfigNode::Kind::kScalar) out.emplace_back(path, node.text());
  for (const auto& [key, value] : node.entries()) {
    if (!path.empty() || kOfNoMatter.count(key) == 0) flatten(value, inner + key, out);
  }
  for (std::size_t i = 0; i < node.items().size(); ++i) {
    flatten(node.items()[i], inner + std::to_string(i), out);
  }
}

std::string nodeText(const NodeReport& n) {
  const auto number = [](const std::optional<std::int64_t>& value) {
    return value ? fmt::format("{:08X}", *value) : std::string("not given");
  };
  return fmt::format("bus {}, node {}, vendor {}, product {}, serial {}, {} {}", n.bus, n.node,
                     number(n.vendor), number(n.product), number(n.serial),
                     n.device.value_or("no name"), n.firmware.value_or(""));
}

const std::string* find(const Pairs& pairs, const std::string& key) {
  const auto at =
      std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == key; });
  return at == pairs.end() ? nullptr : &at->second;
}

void compare(const Pairs& then, const Pairs& now, std::vector<std::string>& changes) {
  for (const auto& [key, value] : then) {
    const std::string* is = find(now, key);
    if (is == nullptr) {
      changes.push_back(fmt::format("{} was {}, is not there any more", key, value));
    } else if (*is != value) {
      changes.push_back(fmt::format("{} was {}, is {}", key, value, *is));
    }
  }
  for (const auto& [key, value] : now) {
    if (find(then, key) == nullptr) {
      changes.push_back(fmt::format("{} is {}, was not there", key, value));
    }
  }
}

nlohmann::ordered_json jsonOf(const Pairs& pairs) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& [key, value] : pairs) out[key] = value;
  return out;
}

Pairs pairsOf(const nlohmann::ordered_json& object) {
  Pairs out;
  for (const auto& [key, value] : object.items()) out.emplace_back(key, value.get<std::string>());
  return out;
}

}  // namespace

CommissioningRecord recordOf(const ConfigNode& bench, const std::vector<NodeReport>& nodes,
                             const std::string& by) {
  CommissioningRecord record;
  record.by = by;
  record.at = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  flatten(bench, "", record.configuration);
  for (const NodeReport& n : nodes) record.nodes.emplace_back(n.name, nodeText(n));
  return record;
}

std::vector<std::string> changesSince(const CommissioningRecord& then,
                                      const CommissioningRecord& now) {
  std::vector<std::string> changes;
  compare(then.configuration, now.configuration, changes);
  compare(then.nodes, now.nodes, changes);
  return changes;
}

std::string commissioningPath(const std::string& bench_path) {
  return std::filesystem::path(bench_path).replace_extension(".commissioned.json").string();
}

void writeCommissioningRecord(const std::string& path, const CommissioningRecord& record,
                              const CommissioningReport& report) {
  nlohmann::ordered_json j;
  j["format"] = kFormat;
  j["commissioned_by"] = record.by;
  j["at"] = record.at;
  j["configuration"] = jsonOf(record.configuration);
  j["nodes"] = jsonOf(record.nodes);
  for (const CommissioningRow& row : report.rows) j["tasks"][row.name] = row.words;
  writeSealedJson(path, j);
}

CommissioningRecord readCommissioningRecord(const std::string& path) {
  const nlohmann::ordered_json j = readSealedJson(path);
  try {
    if (j.at("format") != kFormat) {
      throw InputError(path + ": is no commissioning record of this version; commission anew");
    }
    CommissioningRecord record;
    record.by = j.at("commissioned_by");
    record.at = j.at("at");
    record.configuration = pairsOf(j.at("configuration"));
    record.nodes = pairsOf(j.at("nodes"));
    return record;
  } catch (const nlohmann::json::exception&) {
    throw InputError(path + ": is no commissioning record; commission anew");
  }
}

}  // namespace ballbot
