#include "tools/latency_report.hpp"

#include <utility>

#include <fmt/format.h>

#include "tools/histogram_report.hpp"

namespace ballbot {
namespace {

using LatencyJson = nlohmann::ordered_json;

constexpr const char* kNotApart =
    "Not told apart: \"shared\" holds adapter, driver, the waking of this program and the quickest "
    "node's own reaction; a clock at one end of a wire cannot say which. \"wire\" is a lower "
    "bound: "
    "bits without stuffing, at the configured rate.";

LatencyJson floorJson(const KernelFloor::Result* floor) {
  if (floor == nullptr) return nullptr;
  LatencyJson j = histogramJson(floor->late);
  j["granted"] = floor->grant.text;
  j["period_us"] = 1e-3 * static_cast<double>(floor->period_ns);
  return j;
}

std::string nodeName(const BenchConfig& config, std::size_t node) {
  return node == kDriveCount ? "IMU" : config.drives[node].name;
}

}  // namespace

LatencyJson latencyJson(const RealtimeRunner& runner, const KernelFloor::Result* before,
                        const KernelFloor::Result* meanwhile) {
  const RealtimeRunner::Statistics& s = runner.statistics();
  const BenchConfig& config = runner.bench().config();
  LatencyJson j;
  j["kernel"] = {{"floor_before", floorJson(before)},
                 {"floor_meanwhile", floorJson(meanwhile)},
                 {"wake_for_sync", histogramJson(s.wake)},
                 {"wake_for_command", histogramJson(s.times.act_wake)}};
  j["own_loop"] = {{"sync_out", histogramJson(s.times.sync_out)},
                   {"answers_judged", histogramJson(s.times.judge)},
                   {"command_out", histogramJson(s.times.act)},
                   {"whole", histogramJson(s.times.own)}};
  j["buses"] = LatencyJson::array();
  for (const AnswerProbe::Bus& bus : runner.answers().buses()) {
    j["buses"].push_back({{"has_wire", bus.has_wire},
                          {"answers", histogramJson(bus.answers)},
                          {"wire_at_least", histogramJson(bus.wire)},
                          {"shared", histogramJson(bus.shared)}});
  }
  j["drives"] = LatencyJson::array();
  JitterHistogram all;
  for (std::size_t i = 0; i < runner.answers().nodes().size(); ++i) {
    const AnswerProbe::Node& node = runner.answers().nodes()[i];
    all.add(node.own);
    j["drives"].push_back({{"name", nodeName(config, i)},
                           {"bus", i == kDriveCount ? config.imu.bus : config.drives[i].bus},
                           {"answer", histogramJson(node.answer)},
                           {"own", histogramJson(node.own)}});
  }
  j["all_drives"] = histogramJson(all);
  j["not_apart"] = kNotApart;
  return j;
}

std::string latencyText(const LatencyJson& j) {
  const LatencyJson &kernel = j["kernel"], &own = j["own_loop"];
  std::string table = percentilesHead("where the time goes"), bars;
  for (const auto& [key, what] :
       {std::pair{"floor_before", "kernel: floor, before the bench"},
        std::pair{"floor_meanwhile", "kernel: floor, beside the bench"}}) {
    if (kernel[key].is_null()) continue;
    table += percentilesRow(what, kernel[key]);
    bars += histogramText(what, kernel[key]);
  }
  table += percentilesRow("kernel: wakes the loop for SYNC", kernel["wake_for_sync"]);
  table += percentilesRow("kernel: wakes the loop for the command", kernel["wake_for_command"]);
  table += percentilesRow("own loop: awake to SYNC handed over", own["sync_out"]);
  table += percentilesRow("own loop: answers in to judged", own["answers_judged"]);
  table += percentilesRow("own loop: awake to command handed over", own["command_out"]);
  table += percentilesRow("own loop: the three together", own["whole"]);
  bars += histogramText("own loop, all three", own["whole"]);
  int number = 0;
  for (const LatencyJson& bus : j["buses"]) {
    const std::string name = fmt::format("bus {}: ", number++);
    table += percentilesRow(name + "SYNC handed over to last answer", bus["answers"]);
    if (bus["has_wire"].get<bool>()) {
      table += percentilesRow(name + "wire of that, at least", bus["wire_at_least"]);
    } else {
      table += name + "no wire: answers come sooner than one of its rate carries them\n";
    }
    table += percentilesRow(name + "shared: adapter and quickest node", bus["shared"]);
    bars += histogramText(name + "SYNC handed over to last answer", bus["answers"]);
  }
  for (const LatencyJson& drive : j["drives"]) {
    table += percentilesRow(fmt::format("{} on bus {}: own, beyond the quickest",
                                        drive["name"].get<std::string>(), drive["bus"].get<int>()),
                            drive["own"]);
  }
  bars += histogramText("drives and IMU, own, beyond the quickest of the bus", j["all_drives"]);
  return table + j["not_apart"].get<std::string>() + "\n" + bars;
}

}  // namespace ballbot
