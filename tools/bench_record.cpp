#include "tools/bench_record.hpp"

#include <chrono>
#include <utility>

#include <fmt/format.h>
#include <sys/mman.h>

#include "core/digest.hpp"
#include "experiment/build_info.hpp"
#include "hil/realtime_thread.hpp"
#include "hil/record/write_record.hpp"

namespace ballbot {
namespace {

std::int64_t epochOffsetNs() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count() - monotonicNs();
}

void addProgram(RunFacts& facts) {
  for (const auto& [name, text] : buildInfo()) {
    if (name == "version") facts.version = text;
    if (name == "revision") facts.revision = text;
  }
}

}  // namespace

void addRecordOptions(CLI::App& command, RecordOptions& options) {
  command
      .add_option("--records", options.folder,
                  "Where the last 20 s go when a check fires: in a new folder below this one")
      ->capture_default_str();
  command.add_flag("--keep-record", options.keep, "Leave a record of a good run, too");
}

RunFacts benchFacts(const std::string& bench_file, const std::vector<std::string>& overrides,
                    const ConfigNode& tree) {
  RunFacts facts;
  facts.bench_file = bench_file;
  facts.overrides = overrides;
  Digest digest;
  digest.add(toYaml(tree));
  facts.bench_digest = digest.hex();
  return facts;
}

void recordRun(const BenchRunner& runner, RunFacts facts, const RunEnd& end,
               const RecordOptions& options) {
  const FlightRecorder& recorder = runner.recorder();
  const bool lost = end.code == ExitCode::kLostParticipant || end.code == ExitCode::kTorqueNotOff;
  if (!options.keep && !lost && recorder.first().cycles == 0) return;
  ::munlockall();  // the loop has ended; what is written now need not fit into what may be locked
  facts.exit_code = static_cast<int>(end.code);
  facts.ending = end.text.empty() ? "as it should" : end.text;
  facts.runner = recorder.hasClock() ? "real time" : "stepped";
  facts.epoch_offset_ns = recorder.hasClock() ? epochOffsetNs() : 0;
  addProgram(facts);
  const WrittenRecord written =
      writeRecord({runner.bench(), recorder, std::move(facts)}, options.folder);
  if (!written.folder.empty()) {
    fmt::print(stderr,
               "the last seconds of the bench: {0}/fault.html, or ballbot hil --show-record {0}\n",
               written.folder);
  }
  std::string troubles;
  for (const std::string& text : written.troubles) {
    fmt::print(stderr, "RECORD INCOMPLETE: {}\n", text);
    troubles += (troubles.empty() ? "" : "; ") + text;
  }
  if (!troubles.empty() && end.code == ExitCode::kPassed) {
    throw OutputError("the record of the run is not whole: " + troubles);
  }
}

}  // namespace ballbot
