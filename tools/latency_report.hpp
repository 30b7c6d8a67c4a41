#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "hil/latency/kernel_floor.hpp"
#include "hil/realtime_runner.hpp"

namespace ballbot {

/// Where the time of a real-time bench went: kernel, own loop, buses and drives apart, each with
/// its histogram, and what cannot be told apart. The loop has ended.
/// @param before, meanwhile  the kernel's floor without the bench and beside it; null: not measured
nlohmann::ordered_json latencyJson(const RealtimeRunner& runner, const KernelFloor::Result* before,
                                   const KernelFloor::Result* meanwhile);

/// The same for people: a table, then the histograms. @param json  as latencyJson() gave it
std::string latencyText(const nlohmann::ordered_json& json);

}  // namespace ballbot
