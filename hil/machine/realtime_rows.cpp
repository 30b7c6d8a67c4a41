#include "hil/machine/realtime_rows.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace ballbot {
namespace {

constexpr std::int64_t kPriority = 80, kLockedBytes = 256LL << 20;
constexpr int kLongestExit_us =
    10;                     // of an idle state that a loop with a millisecond to spare bears
constexpr int kQueue = 64;  // frames: two cycles of a bus with six drives

RealtimeRow kernelRow(const MachineFacts& f) {
  return {
      "kernel",     "kernel",
      f.preempt_rt, fmt::format("{}, {}", f.kernel, f.preempt_rt ? "PREEMPT_RT" : "not PREEMPT_RT"),
      "PREEMPT_RT", f.preempt_rt ? "" : "apt install linux-image-rt-amd64, then boot it"};
}

RealtimeRow priorityRow(const ProcessRights& r) {
  RealtimeRow row{"priority", "SCHED_FIFO", r.root || r.priority >= kPriority};
  row.found = r.root ? "root may" : fmt::format("priorities up to {} are allowed", r.priority);
  row.wanted = fmt::format("{} and more", kPriority);
  if (!row.good) {
    row.mend =
        "echo '@realtime - rtprio 98' | sudo tee /etc/security/limits.d/ballbot.conf && sudo "
        "usermod "
        "-aG realtime $USER; in a unit LimitRTPRIO=98";
  }
  return row;
}

RealtimeRow memoryRow(const ProcessRights& r) {
  const bool good = r.root || r.locked_bytes < 0 || r.locked_bytes >= kLockedBytes;
  RealtimeRow row{"locked_memory", "locked memory", good};
  row.found = r.root               ? "root may"
              : r.locked_bytes < 0 ? "unlimited"
                                   : fmt::format("{} kB", r.locked_bytes / 1024);
  row.wanted = "unlimited";
  if (!good) {
    row.mend =
        "echo '@realtime - memlock unlimited' | sudo tee -a /etc/security/limits.d/ballbot.conf; "
        "in "
        "a unit LimitMEMLOCK=infinity";
  }
  return row;
}

RealtimeRow throttlingRow(const MachineFacts& f) {
  RealtimeRow row{"throttling", "throttling", f.rt_runtime_us < 0 || f.rt_runtime_us >= 500'000};
  row.found = f.rt_runtime_us < 0 ? "off"
                                  : fmt::format("real-time threads get {} ms of every second",
                                                f.rt_runtime_us / 1000);
  row.wanted = "off, or more than the loop needs";
  if (!row.good) row.mend = "sudo sysctl -w kernel.sched_rt_runtime_us=950000";
  return row;
}

RealtimeRow isolationRow(const MachineFacts& f, int core) {
  RealtimeRow row{"isolation", "isolated core", contains(f.isolated, core)};
  row.found = "isolated: " + cpuListText(f.isolated);
  row.wanted = fmt::format("core {}", core);
  if (!row.good) {
    row.mend = fmt::format(
        "boot with isolcpus=managed_irq,domain,{0}; the loop does not go there by itself: taskset "
        "-c "
        "{0} ballbot hil BENCH.yaml, in a unit CPUAffinity={0}",
        core);
  }
  return row;
}

RealtimeRow ticklessRow(const MachineFacts& f, int core) {
  RealtimeRow row{"tickless", "tickless core",
                  contains(f.tickless, core) && contains(f.callbacks_away, core)};
  row.found = fmt::format("nohz_full: {}; rcu_nocbs: {}", cpuListText(f.tickless),
                          cpuListText(f.callbacks_away));
  row.wanted = fmt::format("core {} in both", core);
  if (!row.good) row.mend = fmt::format("boot with nohz_full={0} rcu_nocbs={0}", core);
  return row;
}

RealtimeRow interruptsRow(const MachineFacts& f, int core) {
  std::string on_core, numbers;
  for (const DeviceInterrupt& irq : f.interrupts) {
    if (!contains(irq.may_go_to, core)) continue;
    on_core += fmt::format("{}{} ({})", on_core.empty() ? "" : ", ", irq.number, irq.name);
    numbers += " " + irq.number;
  }
  std::vector<int> others = f.online;
  others.erase(std::remove(others.begin(), others.end(), core), others.end());
  RealtimeRow row{"interrupts", "interrupts", on_core.empty() && !f.irqbalance};
  row.found = on_core.empty() ? "none of CAN, USB and network" : "may go to it: " + on_core;
  if (f.irqbalance) row.found += "; irqbalance is running and moves them";
  row.wanted = fmt::format("none of CAN, USB and network on core {}, no irqbalance", core);
  if (row.good) return row;
  if (f.irqbalance) row.mend = "sudo systemctl disable --now irqbalance; ";
  if (others.empty()) {
    row.mend += "a machine with more than one core";
  } else if (!numbers.empty()) {
    row.mend +=
        fmt::format("for i in{}; do echo {} | sudo tee /proc/irq/$i/smp_affinity_list; done",
                    numbers, cpuListText(others));
  }
  return row;
}

RealtimeRow idleRow(const MachineFacts& f) {
  RealtimeRow row{"idle_states", "idle states", true};
  const auto deepest = std::max_element(
      f.idle_states.begin(), f.idle_states.end(),
      [](const IdleState& a, const IdleState& b) { return a.exit_latency_us < b.exit_latency_us; });
  if (f.idle_parameter == "poll" || deepest == f.idle_states.end()) {
    row.found = f.idle_parameter == "poll" ? "idle=poll" : "none that the kernel enters by itself";
  } else {
    row.good = deepest->exit_latency_us <= kLongestExit_us;
    row.found = fmt::format("down to {}, {} us to wake up ({})", deepest->name,
                            deepest->exit_latency_us, f.idle_driver);
  }
  row.wanted = fmt::format("none that takes more than {} us to wake up", kLongestExit_us);
  if (!row.good) {
    row.mend = fmt::format("sudo cpupower idle-set -D {}, or hold /dev/cpu_dma_latency at 0",
                           kLongestExit_us);
  }
  return row;
}

RealtimeRow frequencyRow(const MachineFacts& f, int core) {
  RealtimeRow row{"frequency", "frequency", f.governor.empty() || f.governor == "performance"};
  row.found = f.governor.empty() ? "not scaled by this kernel" : "governor " + f.governor;
  row.wanted = "performance";
  if (!row.good) row.mend = fmt::format("sudo cpupower -c {} frequency-set -g performance", core);
  return row;
}

RealtimeRow queueRow(const MachineFacts& f) {
  RealtimeRow row{"can_queues", "CAN queues", true};
  for (const CanInterface& can : f.can) {
    row.found += fmt::format("{}{} {}", row.found.empty() ? "" : ", ", can.name, can.queue_length);
    if (can.queue_length >= kQueue) continue;
    row.good = false;
    row.mend += fmt::format("{}sudo ip link set {} txqueuelen {}", row.mend.empty() ? "" : "; ",
                            can.name, kQueue);
  }
  if (f.can.empty()) row.found = "no CAN interface here (an slcan adapter needs none)";
  row.wanted = fmt::format("{} frames and more", kQueue);
  return row;
}

RealtimeRow machineRow(const MachineFacts& f) {
  RealtimeRow row{"machine", "machine", !f.virtual_machine};
  row.found = f.virtual_machine ? "a virtual one: its host takes cores away and says nothing"
                                : "no hypervisor";
  row.wanted = "one of its own";
  if (!row.good) row.mend = "run the bench on hardware; no setting in here changes it";
  return row;
}

}  // namespace

std::vector<RealtimeRow> realtimeRows(const MachineFacts& facts, const ProcessRights& rights,
                                      int core) {
  return {
      priorityRow(rights),       memoryRow(rights),    idleRow(facts),   interruptsRow(facts, core),
      frequencyRow(facts, core), throttlingRow(facts), queueRow(facts),  isolationRow(facts, core),
      ticklessRow(facts, core),  kernelRow(facts),     machineRow(facts)};
}

}  // namespace ballbot
