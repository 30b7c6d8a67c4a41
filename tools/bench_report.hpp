#pragma once

#include <nlohmann/json.hpp>

#include "hil/bench.hpp"
#include "hil/bench_io.hpp"
#include "hil/realtime_runner.hpp"

namespace ballbot {

/// How a bench ended and how full its buses were.
nlohmann::ordered_json benchJson(const Bench& bench, const BenchIo& io);

/// How late a real-time loop was: percentiles, overruns, what the system granted.
nlohmann::ordered_json realtimeJson(const RealtimeRunner::Statistics& statistics);

}  // namespace ballbot
