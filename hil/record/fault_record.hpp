#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench.hpp"
#include "hil/recorder/flight_recorder.hpp"

namespace ballbot {

/// What a record says of a run beside what its recorder holds.
struct RunFacts {
  std::string bench_file;
  std::vector<std::string> overrides;
  std::string runner;  ///< "stepped", "real time"
  std::string version, revision;
  std::string bench_digest;   ///< of the bench file with what was changed of it
  std::string config_digest;  ///< of the scenario that bench and controller agree on
  std::string ending;         ///< why the run ended, in words
  int exit_code = 0;
  std::int64_t epoch_offset_ns =
      0;  ///< from bus time to the time since 1970; 0: bus time is no time of day
};

/// A run's last seconds, to be written. Everything outlives this.
struct FaultRecord {
  const Bench& bench;
  const FlightRecorder& recorder;
  RunFacts facts;

  const BenchConfig& config() const { return bench.config(); }
  bool hasFault() const { return recorder.first().cycles > 0; }
  /// Bus time that its page calls zero: the first check's, or the last cycle's [ns].
  std::int64_t zeroNs() const {
    if (hasFault()) return recorder.first().time_ns;
    const auto& cycles = recorder.cycles();
    return cycles.empty() ? 0 : cycles[cycles.size() - 1].time_ns;
  }
  /// The cycle of it.
  std::int64_t zeroCycle() const {
    if (hasFault()) return recorder.first().cycle;
    const auto& cycles = recorder.cycles();
    return cycles.empty() ? 0 : cycles[cycles.size() - 1].cycle;
  }
  /// All frames, in the order in which they passed; where the cycle is the clock, the frames of a
  /// cycle bus by bus, because which bus was read first is nothing that happened in its time.
  std::vector<const RecordedFrame*> frames() const;
  /// Seconds from there.
  double seconds(std::int64_t time_ns) const {
    return 1e-9 * static_cast<double>(time_ns - zeroNs());
  }
};

}  // namespace ballbot
