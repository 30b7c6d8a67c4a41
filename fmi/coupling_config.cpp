#include "fmi/coupling_config.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

/// Relative to the file it is written in; on the command line, to the working folder.
std::string pathOf(const ConfigNode& file) {
  const std::filesystem::path path = file.text();
  const std::string& source = file.where().source;
  if (path.is_absolute() || source.rfind("--", 0) == 0) return path.string();
  return (std::filesystem::path(source).parent_path() / path).lexically_normal().string();
}

void checkName(const std::string& name, const std::string& at) {
  const bool word = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
  if (!word) {
    throw InputError(fmt::format("{} is '{}', must be letters, digits and '_'", at, name));
  }
  if (name == kControllerName || name == kRecordName) {
    throw InputError(fmt::format("{} is '{}', which stands for something else", at, name));
  }
}

std::map<std::string, double> readParameters(const ConfigNode* node, const std::string& path) {
  std::map<std::string, double> out;
  if (!node) return out;
  ConfigReader in(*node, path);
  for (const auto& [key, value] : node->entries()) {
    const bool boolean = value.text() == "true" || value.text() == "false";
    out[key] = boolean ? (in.boolean(key) ? 1.0 : 0.0) : in.number(key);
  }
  return out;
}

std::vector<CouplingLine> readLines(ConfigReader& entry) {
  std::vector<CouplingLine> out;
  const ConfigNode* node = entry.raw("connections");
  std::size_t i = 0;
  for (ConfigReader& in : entry.list("connections")) {
    CouplingLine line;
    line.from = in.text("from");
    line.to = in.text("to");
    line.delayed = in.integerOr("delay_steps", 0, {0, 1}) == 1;
    line.where = node->items()[i++].where();
    in.finish();
    out.push_back(std::move(line));
  }
  return out;
}

}  // namespace

std::vector<FmuEntry> readFmus(const ConfigNode& scenario) {
  std::vector<FmuEntry> out;
  if (!scenario.find("fmus")) return out;
  ConfigReader root(scenario);
  std::set<std::string> names;
  for (ConfigReader& in : root.list("fmus")) {
    FmuEntry e;
    e.name = in.text("name");
    checkName(e.name, in.at("name"));
    if (!names.insert(e.name).second) {
      throw InputError(fmt::format("{} is '{}', as another FMU's is", in.at("name"), e.name));
    }
    e.where = in.raw("name")->where();
    in.text("file");  // checks that it is there and a text
    e.file = pathOf(*in.raw("file"));
    if (!std::filesystem::is_regular_file(e.file)) {
      throw InputError(fmt::format("{} is '{}', but there is no file '{}'", in.at("file"),
                                   in.text("file"), e.file));
    }
    e.parameters = readParameters(in.raw("parameters"), in.path() + ".parameters");
    e.lines = readLines(in);
    e.patience = std::chrono::duration_cast<std::chrono::milliseconds>(
        in.durationOr("patience_s", std::chrono::seconds(10), {0.001, 1e5}));
    in.finish();
    out.push_back(std::move(e));
  }
  return out;
}

}  // namespace ballbot
