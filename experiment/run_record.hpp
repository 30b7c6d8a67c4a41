#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "cosim/remote_participant.hpp"
#include "experiment/run_experiment.hpp"

namespace ballbot {

/// What ran: versions, seed and digests. Written before the run, so that an interrupted one can
/// still be told apart. @throw OutputError
/// @param begins_at  of a run that continues another
void writeManifest(const Scenario& scenario, const RunFolder& folder,
                   std::optional<SimTime> begins_at = std::nullopt);

/// Metrics and verdicts; the same object that `ballbot run --json` prints.
nlohmann::ordered_json summaryJson(const Scenario& scenario, const RunResult& result);
void writeSummary(const Scenario& scenario, const RunResult& result, const RunFolder& folder);

/// Wall-clock facts: the only file of a run folder that differs between two equal runs.
/// @param plan_times  of each plan() call
void writeTiming(const RunResult& result, const RemoteParticipant::LinkStatistics& link,
                 const std::vector<PlanTiming>& plan_times, std::int64_t log_bytes,
                 const RunFolder& folder);

}  // namespace ballbot
