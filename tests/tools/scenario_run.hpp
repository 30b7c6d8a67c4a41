#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {

/// A shipped scenario in one process, as quickly as it goes.
struct ScenarioRun {
  std::string scenario;
  std::vector<std::string> changes;  ///< path=value
  int seed = 1;
  std::string out{};  ///< run folder; without one it is gone at once
  bool report = false;
  int timeout_s = 300;
};

/// Does it, whatever its verdict. @return what --json says; null, and a failed test, where it was
/// not even judged
inline nlohmann::json summaryOf(const ScenarioRun& run) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"run",
                                        scenarioPath(run.scenario),
                                        "--seed",
                                        std::to_string(run.seed),
                                        "--in-process",
                                        "--quiet",
                                        "--json",
                                        "--out",
                                        run.out.empty() ? folder / "run" : run.out};
  if (!run.report) arguments.emplace_back("--no-report");
  for (const std::string& change : run.changes) {
    arguments.emplace_back("--set");
    arguments.push_back(change);
  }
  const Finished done = runBallbot(arguments, run.timeout_s);
  EXPECT_LE(done.exit_code, 1) << done.err;
  auto summary = nlohmann::json::parse(done.out, nullptr, false);
  EXPECT_FALSE(summary.is_discarded()) << done.err;
  return summary.is_discarded() ? nlohmann::json() : summary;
}

}  // namespace ballbot
