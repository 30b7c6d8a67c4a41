#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/config_node.hpp"
#include "core/error.hpp"
#include "hil/bench_runner.hpp"
#include "hil/record/fault_record.hpp"

namespace ballbot {

/// Where the records of a bench go, and whether a good run leaves one too.
struct RecordOptions {
  std::string folder = "runs";
  bool keep = false;
};
/// `--records` and `--keep-record`. @param options  must outlive the command
void addRecordOptions(CLI::App& command, RecordOptions& options);

/// How a run ended, to be said last.
struct RunEnd {
  ExitCode code = ExitCode::kPassed;
  std::string text;  ///< "" if all is well
};

/// What a record says of the bench that runs.
RunFacts benchFacts(const std::string& bench_file, const std::vector<std::string>& overrides,
                    const ConfigNode& tree);

/// Writes the runner's record where the run calls for one: a check fired, somebody was lost, torque
/// may be on, or it is wanted. Says on stderr where it is, or what could not be written. The drives
/// are off, and the runner's loop has ended.
/// @param facts  as benchFacts() gave them; how the run ended, runner, program and time are added
/// @throw OutputError  a good run's record that was asked for is not whole; after a fault that is
/// only
///                     said, because the fault is graver
void recordRun(const BenchRunner& runner, RunFacts facts, const RunEnd& end,
               const RecordOptions& options);

/// Prints a record: what fired first, what followed, the cycles around it, the frames of its cycle.
/// @throw InputError if the folder holds none.
void showRecord(const std::string& folder, bool json);

}  // namespace ballbot
