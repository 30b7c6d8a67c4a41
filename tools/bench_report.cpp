#include "tools/bench_report.hpp"

#include <utility>

namespace ballbot {
namespace {

nlohmann::ordered_json percentilesJson(const JitterHistogram& h) {
  nlohmann::ordered_json out;
  const std::pair<const char*, double> shares[] = {
      {"p50_us", 0.5}, {"p99_us", 0.99}, {"p999_us", 0.999}, {"max_us", 1.0}};
  for (const auto& [name, share] : shares) {
    out[name] = 1e-3 * static_cast<double>(h.percentile(share));
  }
  return out;
}

}  // namespace

nlohmann::ordered_json benchJson(const Bench& bench, const BenchIo& io) {
  const BenchConfig& config = bench.config();
  nlohmann::ordered_json out;
  const auto cycles = static_cast<double>(bench.master().cycle());
  out["cycles"] = bench.master().cycle();
  out["state"] = toText(bench.safety().state());
  out["fault"] = bench.faultText();
  out["saturated_cycles"] = bench.saturatedCycles();
  out["bad_pdos"] = bench.master().badPdos();
  out["bus_load"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < config.buses.size() && cycles > 0; ++i) {
    const BenchIo::Load& load = io.load(static_cast<int>(i));
    const double capacity = cycles * config.cycleSeconds() * 1000.0 * config.buses[i].bitrate_kbps;
    out["bus_load"].push_back({{"nominal", static_cast<double>(load.nominal) / capacity},
                               {"worst_stuffing", static_cast<double>(load.worst) / capacity}});
  }
  return out;
}

nlohmann::ordered_json realtimeJson(const RealtimeRunner::Statistics& s) {
  nlohmann::ordered_json out;
  out["granted"] = s.grant.text;
  out["cycles"] = s.cycles;
  out["overruns"] = s.overruns;
  out["periods_skipped"] = s.skipped;
  out["cycles_without_new_command"] = s.commands_missing;
  out["records_lost"] = s.records_lost;
  out["wake_late"] = percentilesJson(s.wake);
  out["sync_to_torque"] = percentilesJson(s.act);
  return out;
}

}  // namespace ballbot
