#include "hil/machine/worth.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace ballbot {
namespace {

/// "p50 90 -> 44, p99 900 -> 70, max 5000 -> 346 us".
std::string difference(const JitterHistogram& without, const JitterHistogram& with) {
  const auto us = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-3; };
  return fmt::format("p50 {:.0f} -> {:.0f}, p99 {:.0f} -> {:.0f}, max {:.0f} -> {:.0f} us",
                     us(without.percentile(0.5)), us(with.percentile(0.5)),
                     us(without.percentile(0.99)), us(with.percentile(0.99)), us(without.max()),
                     us(with.max()));
}

std::int64_t countOf(const InterruptTable& table, const std::string& number, int core) {
  const auto column = std::find(table.cpus.begin(), table.cpus.end(), core) - table.cpus.begin();
  for (const InterruptLine& line : table.lines) {
    if (line.number != number) continue;
    const auto n = static_cast<std::size_t>(column);
    return n < line.counts.size() ? line.counts[n] : 0;
  }
  return 0;
}

/// Interrupts per second of a line, or of all devices, on a core.
double rate(const FloorMeasurements& m, const std::string& number, int core) {
  const auto grown =
      countOf(m.interrupts_after, number, core) - countOf(m.interrupts_before, number, core);
  return static_cast<double>(grown) / m.seconds;
}

double deviceRate(const FloorMeasurements& m, int core) {
  double sum = 0;
  for (const InterruptLine& line : m.interrupts_after.lines) {
    if (line.number.find_first_not_of("0123456789") != std::string::npos) continue;
    sum += rate(m, line.number, core);
  }
  return sum;
}

void sayMeasured(RealtimeRow& row, std::string text) {
  row.worth = std::move(text);
  row.measured = true;
}

void onPriority(RealtimeRow& row, const FloorMeasurements& m) {
  if (m.grant.fifo) {
    return sayMeasured(row, "lateness of a thread that only sleeps, without and with it: " +
                                difference(m.ordinary, m.fifo));
  }
  row.good = false;
  row.found += "; refused: " + m.grant.text;
  row.worth = "not measurable here: SCHED_FIFO is refused";
}

void onIdleStates(RealtimeRow& row, const FloorMeasurements& m) {
  if (m.held_awake) {
    return sayMeasured(
        row, "without and with /dev/cpu_dma_latency at 0: " + difference(m.fifo, m.awake));
  }
  row.worth = "not measurable here: /dev/cpu_dma_latency cannot be opened (root can)";
}

}  // namespace

void addWorth(std::vector<RealtimeRow>& rows, const FloorMeasurements& m, int core) {
  for (RealtimeRow& row : rows) {
    if (row.name == "priority") {
      onPriority(row, m);
    } else if (row.name == "locked_memory") {
      row.worth = "not measurable here: it shows when memory runs short, as a wait for the disk";
    } else if (row.name == "idle_states") {
      onIdleStates(row, m);
    } else if (row.name == "interrupts") {
      sayMeasured(row, fmt::format("core {} had {:.0f} interrupts of devices a second meanwhile",
                                   core, deviceRate(m, core)));
    } else if (row.name == "tickless") {
      sayMeasured(row, fmt::format("core {} had {:.0f} timer interrupts a second meanwhile, about "
                                   "1000 of them to wake the measuring thread",
                                   core, rate(m, "LOC", core)));
    } else if (row.name == "isolation") {
      sayMeasured(row, "pinning alone, without and with: " + difference(m.unpinned, m.fifo) +
                           "; isolation itself takes another boot to measure");
    } else if (row.name == "machine") {
      sayMeasured(row, fmt::format("the host says that it took {} ms of {:.1f} s from core {}",
                                   m.stolen_ms, m.seconds, core));
    } else if (row.name == "frequency") {
      row.worth = "not measurable here without changing it";
    } else if (row.name == "throttling") {
      row.worth = "not measurable here: it stops only a loop that never sleeps";
    } else if (row.name == "can_queues") {
      row.worth = "not measurable here: a queue that is full refuses frames, and drives miss them";
    } else if (row.name == "kernel") {
      row.worth = "not measurable here: it takes another boot";
    }
  }
}

}  // namespace ballbot
