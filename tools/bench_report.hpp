#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hil/bench.hpp"
#include "hil/bench_check.hpp"
#include "hil/bench_io.hpp"
#include "hil/latency/kernel_floor.hpp"
#include "hil/realtime_runner.hpp"

namespace ballbot {

/// How a bench ended and how full its buses were.
nlohmann::ordered_json benchJson(const Bench& bench, const BenchIo& io);

/// How late a real-time loop was: percentiles and histograms of lateness, deadline misses, what the
/// system granted, and where the time went.
/// The loop has ended. @param before, meanwhile  the kernel's floor; null: not measured
nlohmann::ordered_json realtimeJson(const RealtimeRunner& runner,
                                    const KernelFloor::Result* before = nullptr,
                                    const KernelFloor::Result* meanwhile = nullptr);

/// The two above for people: a few lines, and in real time a table and histograms. @param report as
/// they gave it
std::string benchText(const nlohmann::ordered_json& report);

/// What `hil --check` found, as JSON and as a table.
/// @param sheets  where the bench file and the drives' data sheets disagree
nlohmann::ordered_json checkJson(const std::vector<NodeReport>& nodes,
                                 const std::vector<std::string>& sheets);
std::string checkTable(const std::vector<NodeReport>& nodes,
                       const std::vector<std::string>& sheets);
/// Whether every node is there, without error, and agrees with the configuration.
bool allGood(const std::vector<NodeReport>& nodes);

}  // namespace ballbot
