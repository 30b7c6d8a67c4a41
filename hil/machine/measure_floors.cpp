#include <chrono>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <unistd.h>

#include "hil/latency/kernel_floor.hpp"
#include "hil/machine/worth.hpp"

namespace ballbot {
namespace {

constexpr int kRounds = 4;
constexpr int kStealColumn = 8;  // of a line of /proc/stat, its name counted

InterruptTable interruptsNow() {
  std::ifstream in("/proc/interrupts");
  std::ostringstream text;
  text << in.rdbuf();
  return parseInterrupts(text.str());
}

std::int64_t stolenMs(int core) {
  std::ifstream in("/proc/stat");
  const std::string name = fmt::format("cpu{}", core);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word != name) continue;
    for (int i = 0; i < kStealColumn; ++i) words >> word;
    return std::atoll(word.c_str()) * 1000 / ::sysconf(_SC_CLK_TCK);
  }
  return 0;
}

}  // namespace

FloorMeasurements measureFloors(int core, double seconds, const std::atomic<bool>* stop) {
  FloorMeasurements m;
  FloorSettings fifo;
  fifo.core = core;
  FloorSettings ordinary = fifo, awake = fifo, unpinned = fifo;
  ordinary.realtime = false;
  awake.hold_cpu_awake = true;
  unpinned.core = -1;
  const auto begun = std::chrono::steady_clock::now();
  const std::int64_t stolen = stolenMs(core);
  m.interrupts_before = interruptsNow();
  for (int round = 0; round < kRounds; ++round) {
    const double share = seconds / kRounds;
    const KernelFloor::Result now = measureFloor(fifo, share, stop);
    m.grant = now.grant;
    m.fifo.add(now.late);
    m.ordinary.add(measureFloor(ordinary, share, stop).late);
    const KernelFloor::Result held = measureFloor(awake, share, stop);
    m.held_awake = held.held_awake;
    m.awake.add(held.late);
    m.unpinned.add(measureFloor(unpinned, share, stop).late);
  }
  m.interrupts_after = interruptsNow();
  m.stolen_ms = stolenMs(core) - stolen;
  m.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return m;
}

}  // namespace ballbot
