#include "tools/bench_report.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tools/histogram_report.hpp"
#include "tools/latency_report.hpp"

namespace ballbot {
namespace {

using Report = nlohmann::ordered_json;

std::string realtimeText(const Report& r) {
  std::string out = fmt::format("real time: {}\n", r["granted"].get<std::string>());
  out += histogramText("SYNC late by", r["wake_late"]);
  out += histogramText("torque on its way after the deadline of SYNC", r["sync_to_torque"]);
  out += fmt::format("deadline misses: {} cycles took longer than their period, {} periods skipped",
                     r["overruns"].get<std::int64_t>(), r["periods_skipped"].get<std::int64_t>());
  for (const Report& row : r["misses"]) {
    out += fmt::format("; {} times {} in a row", row["count"].get<std::int64_t>(),
                       row["periods"].get<int>());
  }
  return out + fmt::format("\ncycles without a new command: {}\n",
                           r["cycles_without_new_command"].get<std::int64_t>());
}

}  // namespace

Report benchJson(const Bench& bench, const BenchIo& io) {
  const BenchConfig& config = bench.config();
  Report out;
  const auto cycles = static_cast<double>(bench.master().cycle());
  out["cycles"] = bench.master().cycle();
  out["state"] = toText(bench.safety().state());
  out["fault"] = bench.faultText();
  out["check"] = checkOf(bench.safety().fault()).name;
  out["torque_off"] = bench.torqueIsOff();
  out["last_word"] = bench.lastWord();
  out["saturated_cycles"] = bench.saturatedCycles();
  out["bad_pdos"] = bench.master().badPdos();
  out["late_pdos"] = bench.master().latePdos();
  out["bus_load"] = Report::array();
  for (std::size_t i = 0; i < config.buses.size() && cycles > 0; ++i) {
    const FrameBits& load = io.load(static_cast<int>(i));
    const CanBusSettings& bus = config.buses[i].settings;
    const auto share = [&](const WireBits& bits) {
      return 1e-6 * bits.microseconds(bus.bitrate_kbps, bus.data_bitrate_kbps) /
             (cycles * config.cycleSeconds());
    };
    out["bus_load"].push_back(
        {{"nominal", share(load.nominal)}, {"worst_stuffing", share(load.worst)}});
  }
  return out;
}

Report realtimeJson(const RealtimeRunner& runner, const KernelFloor::Result* before,
                    const KernelFloor::Result* meanwhile) {
  const RealtimeRunner::Statistics& s = runner.statistics();
  Report out;
  out["granted"] = s.grant.text;
  out["cycles"] = s.cycles;
  out["overruns"] = s.overruns;
  out["periods_skipped"] = s.skipped;
  out["misses"] = Report::array();
  for (std::size_t i = 1; i < s.misses.size(); ++i) {
    if (s.misses[i] > 0) out["misses"].push_back({{"periods", i}, {"count", s.misses[i]}});
  }
  out["cycles_without_new_command"] = s.commands_missing;
  out["records_lost"] = s.records_lost;
  out["wake_late"] = histogramJson(s.wake);
  out["sync_to_torque"] = histogramJson(s.act);
  out["latency"] = latencyJson(runner, before, meanwhile);
  return out;
}

std::string benchText(const Report& r) {
  std::string out = fmt::format("bench: {} after {} cycles, {} with torque cut to its limits\n",
                                r["state"].get<std::string>(), r["cycles"].get<std::int64_t>(),
                                r["saturated_cycles"].get<std::int64_t>());
  if (!r["fault"].get<std::string>().empty()) {
    out += fmt::format("fault: {}\n", r["fault"].get<std::string>());
  }
  out += r["torque_off"].get<bool>() ? "torque: off, as every drive has said\n"
                                     : r["last_word"].get<std::string>();
  int bus = 0;
  for (const Report& load : r["bus_load"]) {
    out += fmt::format("bus {}: load {:.0f} %, {:.0f} % with the most stuffing\n", bus++,
                       100 * load["nominal"].get<double>(),
                       100 * load["worst_stuffing"].get<double>());
  }
  out += fmt::format("PDOs of wrong length: {}, too late: {}\n", r["bad_pdos"].get<std::int64_t>(),
                     r["late_pdos"].get<std::int64_t>());
  if (!r.contains("realtime")) return out;
  return out + realtimeText(r["realtime"]) + latencyText(r["realtime"]["latency"]);
}

bool allGood(const std::vector<NodeReport>& nodes) {
  return std::all_of(nodes.begin(), nodes.end(), [](const NodeReport& r) {
    return r.found && r.disagreements.empty() && r.last_error.empty();
  });
}

Report checkJson(const std::vector<NodeReport>& nodes, const std::vector<std::string>& sheets) {
  const auto orNull = [](const auto& value) { return value ? Report(*value) : Report(nullptr); };
  Report list = Report::array();
  for (const NodeReport& r : nodes) {
    list.push_back({{"name", r.name},
                    {"bus", r.bus},
                    {"node", r.node},
                    {"found", r.found},
                    {"data_sheet", r.data_sheet},
                    {"device", orNull(r.device)},
                    {"firmware", orNull(r.firmware)},
                    {"serial", orNull(r.serial)},
                    {"rated_torque_Nm", orNull(r.rated_torque_Nm)},
                    {"max_torque_Nm", orNull(r.max_torque_Nm)},
                    {"encoder_counts", orNull(r.encoder_counts)},
                    {"supply_V", orNull(r.supply_V)},
                    {"temperature_degC", orNull(r.temperature_degC)},
                    {"state", orNull(r.state)},
                    {"last_error", r.last_error},
                    {"not_given", r.not_given},
                    {"disagreements", r.disagreements}});
  }
  return {{"nodes", list},
          {"data_sheets_disagree", sheets},
          {"good", allGood(nodes) && sheets.empty()}};
}

std::string checkTable(const std::vector<NodeReport>& nodes,
                       const std::vector<std::string>& sheets) {
  // What was not given is a dash here and stands in words below.
  const auto cell = [](const auto& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : std::string("-");
  };
  std::string out = fmt::format(
      "{:<8} {:>3} {:>4}  {:<24} {:>8} {:>6} {:>8} {:>6} {:>8} {:>6} {:>5}  {}\n", "", "bus",
      "node", "device", "firmware", "serial", "rated Nm", "max Nm", "counts", "degC", "V", "state");
  for (const NodeReport& r : nodes) {
    out += fmt::format("{:<8} {:>3} {:>4}  ", r.name, r.bus, r.node);
    if (!r.found) {
      out += "does not answer\n";
      continue;
    }
    out += fmt::format("{:<24} {:>8} {:>6}", cell(r.device, "{}"), cell(r.firmware, "{}"),
                       cell(r.serial, "{}"));
    if (r.is_drive) {
      out += fmt::format(" {:>8} {:>6} {:>8} {:>6} {:>5}  {}", cell(r.rated_torque_Nm, "{:.4g}"),
                         cell(r.max_torque_Nm, "{:.4g}"), cell(r.encoder_counts, "{}"),
                         cell(r.temperature_degC, "{:.4g}"), cell(r.supply_V, "{:.3g}"),
                         cell(r.state, "{}"));
    }
    out += '\n';
    if (!r.last_error.empty()) out += fmt::format("         last error: {}\n", r.last_error);
    for (const std::string& text : r.not_given) {
      out += fmt::format("         NOT GIVEN: {}\n", text);
    }
    for (const std::string& text : r.disagreements) {
      out += fmt::format("         DIFFERS: {}\n", text);
    }
  }
  std::set<std::string> named;
  for (const NodeReport& r : nodes) {
    if (r.data_sheet.empty() || !named.insert(r.data_sheet).second) continue;
    out += fmt::format("data sheet: {}\n", r.data_sheet);
  }
  for (const std::string& text : sheets) out += fmt::format("DATA SHEET DIFFERS: {}\n", text);
  return out;
}

}  // namespace ballbot
