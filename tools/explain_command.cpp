#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/scenario_keys.hpp"
#include "hil/bench_config.hpp"
#include "hil/emulator/emulator_config.hpp"
#include "report/json_text.hpp"
#include "studies/study_definition.hpp"
#include "tools/commands.hpp"

namespace ballbot {
namespace {

struct ExplainArguments {
  std::string key, file = "scenario";
  bool json = false, schema = false, reference = false;
};

nlohmann::ordered_json toJson(const KeyEntry& e) {
  nlohmann::ordered_json out = {{"key", e.path}, {"words", e.words}, {"type", typeText(e)}};
  out["unit"] = e.unit;
  out["required"] = e.required;
  out["default"] = nullptr;
  if (!e.required && !e.fallback.empty()) out["default"] = e.fallback;
  if (!e.choices.empty()) out["choices"] = e.choices;
  return out;
}

std::string defaultText(const KeyEntry& e) {
  if (e.required) return "must be there";
  return e.fallback.empty() ? "may be absent" : "default " + e.fallback;
}

void printWhole(const KeyEntry& e) {
  fmt::print("{}\n  {}\n", e.path, e.words);
  fmt::print("  {}{}\n", typeText(e), e.unit.empty() ? "" : fmt::format(" [{}]", e.unit));
  fmt::print("  {}\n", defaultText(e));
}

/// How many levels a key lies below another.
std::size_t depthBelow(const std::string& path, const std::string& top) {
  std::size_t depth = 0;
  for (std::size_t i = top.size(); i < path.size(); ++i) depth += path[i] == '.';
  return top.empty() ? depth + 1 : depth;
}

/// A mapping's own keys, and how many lie below each that is one itself.
void printBelow(const std::string& top, const std::vector<KeyEntry>& keys) {
  std::size_t width = 0;
  const auto shown = [&](const KeyEntry& e) {
    const std::size_t depth = depthBelow(e.path, top);
    return depth == 1 || (depth == 2 && e.path.compare(top.size(), 3, ".0.") == 0);
  };
  const auto name = [&](const KeyEntry& e) {
    return e.path.substr(top.empty() ? 0 : top.size() + 1);
  };
  for (const KeyEntry& e : keys) {
    if (e.path != top && shown(e)) width = std::max(width, name(e).size());
  }
  for (const KeyEntry& e : keys) {
    if (e.path == top || !shown(e)) continue;
    const bool mapping = e.kind == KeyKind::kSection || e.kind == KeyKind::kList;
    fmt::print("  {:<{}}  {}{}", name(e), width, e.words,
               e.unit.empty() ? "" : fmt::format(" [{}]", e.unit));
    fmt::print("{}\n", mapping ? "" : fmt::format(" ({})", defaultText(e)));
  }
}

/// As docs/keys.md has it: a table for each mapping, in the order in which they are told.
void printReference(const std::vector<KeyEntry>& book) {
  std::vector<std::pair<std::string, std::vector<const KeyEntry*>>> tables;
  for (const KeyEntry& e : book) {
    if (e.kind == KeyKind::kSection || e.kind == KeyKind::kList) continue;
    const std::size_t dot = e.path.rfind('.');
    const std::string of = dot == std::string::npos ? "" : e.path.substr(0, dot);
    const auto known = std::find_if(tables.begin(), tables.end(),
                                    [&](const auto& table) { return table.first == of; });
    if (known != tables.end()) {
      known->second.push_back(&e);
    } else {
      tables.push_back({of, {&e}});
    }
  }
  for (const auto& [of, keys] : tables) {
    fmt::print("{}", of.empty() ? "" : fmt::format("\n## {}\n\n", of));
    fmt::print("| key | what | type | unit | default |\n|---|---|---|---|---|\n");
    for (const KeyEntry* e : keys) {
      fmt::print("| `{}` | {} | {} | {} | {} |\n", e->path.substr(e->path.rfind('.') + 1), e->words,
                 typeText(*e), e->unit, e->required ? "required" : e->fallback);
    }
  }
}

KeyBook keysOf(const std::string& file) {
  ConfigListing listing;
  if (file == "study") {
    Study().describe(listing);
    return {"study", listing.take()};
  }
  if (file == "bench") {
    BenchConfig().describe(listing);
    listing.section(emulatorSection(), [](ConfigVisitor& in) { EmulatorConfig().describe(in); });
    return {"bench file", listing.take()};
  }
  return scenarioKeys();
}

ExitCode explain(const ExplainArguments& a) {
  const KeyBook book = keysOf(a.file);
  if (a.schema) {
    fmt::print("{}", book.schema());
    return ExitCode::kPassed;
  }
  if (a.reference) {
    printReference(book.keys);
    return ExitCode::kPassed;
  }
  const std::vector<KeyEntry> keys = a.key.empty() ? book.keys : book.at(a.key);
  if (a.json) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const KeyEntry& e : keys) out.push_back(toJson(e));
    fmt::print("{}\n", jsonText(out));
    return ExitCode::kPassed;
  }
  if (!a.key.empty() && keys.size() == 1) {
    printWhole(keys.front());
    return ExitCode::kPassed;
  }
  if (!a.key.empty()) fmt::print("{}\n  {}\n", keys.front().path, keys.front().words);
  printBelow(a.key.empty() ? "" : keys.front().path, keys);
  return ExitCode::kPassed;
}

}  // namespace

void addExplainCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "explain",
      "What a key of a scenario, a bench file or a study means: words, unit, range, default");
  const auto a = std::make_shared<ExplainArguments>();
  command->add_option("key", a->key, "Dotted path, e.g. plant.fidelity.friction (default: all)");
  command->add_option("--file", a->file, "Which kind of file has it")
      ->check(CLI::IsMember({"scenario", "bench", "study"}))
      ->capture_default_str();
  command->add_flag("--json", a->json, "Print the key, and all below it, as JSON");
  command->add_flag("--schema", a->schema, "Print the JSON schema of such files");
  command->add_flag("--reference", a->reference, "Print all keys as tables, as in docs/keys.md");
  command->footer(
      "Examples:\n"
      "  ballbot explain\n"
      "  ballbot explain plant.fidelity.friction\n"
      "  ballbot explain controller.mpc\n"
      "  ballbot explain --file bench safety.ramp_ms\n"
      "  ballbot explain --schema > scenario.schema.json\n"
      "Exit codes: 0 explained, 2 there is no such key.");
  command->callback([&result, a] { result = explain(*a); });
}

}  // namespace ballbot
