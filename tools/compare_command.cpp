#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/number_text.hpp"
#include "experiment/run_comparison.hpp"
#include "experiment/run_folder.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"

namespace ballbot {
namespace {

struct CompareArguments {
  std::string a, b;
  bool json = false;
};

nlohmann::ordered_json toJson(const RunComparison& c) {
  nlohmann::ordered_json out;
  out["identical"] = c.identical();
  out["text"] = c.text();
  if (c.difference) {
    out["first_difference"] = {{"tick", c.difference->tick},
                               {"time_s", decimalSeconds(toNs(c.difference->time))},
                               {"text", c.difference->text}};
    if (c.difference->channel) {
      out["first_difference"]["channel"] = channelName(*c.difference->channel);
    }
  }
  for (const auto& [name, values] : c.metrics) out["metrics"][name] = {values.first, values.second};
  if (!c.notes.empty()) out["notes"] = c.notes;
  return out;
}

ExitCode compareFolders(const CompareArguments& arguments) {
  const RunFolder a = RunFolder::open(arguments.a);  // before b: the first that is wrong is named
  const RunComparison c = compareRuns(a, RunFolder::open(arguments.b));
  if (arguments.json) {
    fmt::print("{}\n", jsonText(toJson(c)));
  } else {
    fmt::print("{}\n", c.text());
    for (const std::string& note : c.notes) fmt::print("{}\n", note);
    if (!c.metrics.empty()) fmt::print("{:<32} {:>14} {:>14}\n", "metric", "first", "second");
    for (const auto& [name, values] : c.metrics) {
      fmt::print("{:<32} {:>14.6g} {:>14.6g}\n", name, values.first, values.second);
    }
  }
  return c.identical() ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

}  // namespace

void addCompareCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command =
      program.add_subcommand("compare", "Say where two runs differ first, and their metrics");
  const auto a = std::make_shared<CompareArguments>();
  command->add_option("first", a->a, "Run folder")->required();
  command->add_option("second", a->b, "Run folder")->required();
  command->add_flag("--json", a->json, "Print as JSON");
  command->footer(
      "Example:\n  ballbot compare runs/push-001 runs/push-002\n"
      "Exit codes: 0 identical, 1 they differ, 2 bad input, or a folder is damaged or was edited.");
  command->callback([&result, a] { result = compareFolders(*a); });
}

}  // namespace ballbot
