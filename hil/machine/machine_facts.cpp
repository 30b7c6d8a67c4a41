#include "hil/machine/machine_facts.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

namespace ballbot {
namespace {

constexpr const char* kCpus = "/sys/devices/system/cpu/";
constexpr int kCanDevice = 280;  // ARPHRD_CAN in /sys/class/net/NAME/type

std::string wholeText(const std::string& root, const std::string& path) {
  std::ifstream in(root + path);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::vector<IdleState> idleStates(const std::string& root, int core) {
  const std::string folder = fmt::format("{}cpu{}/cpuidle/", kCpus, core);
  std::vector<IdleState> states;
  for (const std::string& state : namesIn(root, folder)) {
    if (firstLine(root, folder + state + "/disable") == "1") continue;
    states.push_back({firstLine(root, folder + state + "/name"),
                      std::atoi(firstLine(root, folder + state + "/latency").c_str())});
  }
  return states;
}

/// What a CAN adapter's frames come by, as interrupts name it: USB's host controllers, CAN
/// controllers, network interfaces and the devices behind these ("virtio2").
std::vector<std::string> frameCarriers(const std::string& root) {
  std::vector<std::string> words = {"hcd", "can", "peak", "mcp25"};
  for (const std::string& name : namesIn(root, "/sys/class/net")) {
    if (name == "lo") continue;
    words.push_back(name);
    std::error_code failed;
    const auto device =
        std::filesystem::read_symlink(root + "/sys/class/net/" + name + "/device", failed);
    if (!failed) words.push_back(device.filename());
  }
  return words;
}

bool carriesFrames(const std::string& name, const std::vector<std::string>& carriers) {
  return std::any_of(carriers.begin(), carriers.end(),
                     [&](const std::string& word) { return name.find(word) != std::string::npos; });
}

std::vector<DeviceInterrupt> deviceInterrupts(const std::string& root) {
  const std::vector<std::string> carriers = frameCarriers(root);
  std::vector<DeviceInterrupt> list;
  for (const InterruptLine& line : parseInterrupts(wholeText(root, "/proc/interrupts")).lines) {
    const std::string where = firstLine(root, "/proc/irq/" + line.number + "/smp_affinity_list");
    if (where.empty() || !carriesFrames(line.name, carriers)) continue;
    const std::size_t blank = line.name.find_last_of(' ');  // after chip and line: the device
    const std::string device = blank == std::string::npos ? line.name : line.name.substr(blank + 1);
    list.push_back({line.number, device, parseCpuList(where)});
  }
  return list;
}

bool runs(const std::string& root, const std::string& program) {
  for (const std::string& name : namesIn(root, "/proc")) {
    const bool process = name.find_first_not_of("0123456789") == std::string::npos;
    if (process && firstLine(root, "/proc/" + name + "/comm") == program) return true;
  }
  return false;
}

std::vector<CanInterface> canInterfaces(const std::string& root) {
  std::vector<CanInterface> list;
  for (const std::string& name : namesIn(root, "/sys/class/net")) {
    const std::string folder = "/sys/class/net/" + name;
    if (std::atoi(firstLine(root, folder + "/type").c_str()) != kCanDevice) continue;
    list.push_back({name, std::atoi(firstLine(root, folder + "/tx_queue_len").c_str())});
  }
  return list;
}

}  // namespace

MachineFacts readMachine(const std::string& root, int core) {
  MachineFacts facts;
  const std::string command_line = firstLine(root, "/proc/cmdline");
  facts.kernel = firstLine(root, "/proc/sys/kernel/osrelease");
  facts.preempt_rt =
      firstLine(root, "/sys/kernel/realtime") == "1" ||
      firstLine(root, "/proc/sys/kernel/version").find("PREEMPT_RT") != std::string::npos;
  facts.online = parseCpuList(firstLine(root, std::string(kCpus) + "online"));
  facts.isolated = parseCpuList(firstLine(root, std::string(kCpus) + "isolated"));
  facts.tickless = parseCpuList(firstLine(root, std::string(kCpus) + "nohz_full"));
  facts.callbacks_away = parseCpuList(bootParameter(command_line, "rcu_nocbs"));
  facts.idle_parameter = bootParameter(command_line, "idle");
  facts.idle_driver = firstLine(root, std::string(kCpus) + "cpuidle/current_driver");
  facts.idle_states = idleStates(root, core);
  facts.governor = firstLine(root, fmt::format("{}cpu{}/cpufreq/scaling_governor", kCpus, core));
  facts.interrupts = deviceInterrupts(root);
  facts.irqbalance = runs(root, "irqbalance");
  facts.can = canInterfaces(root);
  facts.rt_runtime_us = std::atoll(firstLine(root, "/proc/sys/kernel/sched_rt_runtime_us").c_str());
  facts.virtual_machine = wholeText(root, "/proc/cpuinfo").find(" hypervisor") != std::string::npos;
  return facts;
}

}  // namespace ballbot
