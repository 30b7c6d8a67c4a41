#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/machine/proc_text.hpp"

namespace ballbot {

/// An idle state of a core that may be entered.
struct IdleState {
  std::string name;
  int exit_latency_us = 0;
};

/// An interrupt of a device, and where it may go.
struct DeviceInterrupt {
  std::string number, name;
  std::vector<int> may_go_to;
};

struct CanInterface {
  std::string name;
  int queue_length = 0;  ///< txqueuelen
};

/// What of a machine decides how late a real-time loop is, as /proc and /sys say it.
struct MachineFacts {
  bool preempt_rt = false;
  std::string kernel;               ///< release
  std::vector<int> online;          ///< processors
  std::vector<int> isolated;        ///< isolcpus=, or a cpuset's isolated partition
  std::vector<int> tickless;        ///< nohz_full=
  std::vector<int> callbacks_away;  ///< rcu_nocbs=
  std::string idle_parameter;       ///< idle= of the command line
  std::string idle_driver;
  std::vector<IdleState> idle_states;  ///< of the loop's core, those not disabled
  std::string governor;  ///< of the loop's core; "" if its frequency is not scaled here
  std::vector<DeviceInterrupt> interrupts;  ///< of CAN, USB and network devices
  bool irqbalance = false;                  ///< is running
  std::vector<CanInterface> can;
  std::int64_t rt_runtime_us = 0;  ///< of every second; -1: all of it
  bool virtual_machine = false;
};

/// @param root  "" for this machine; a test brings a tree of its own
/// @param core  of the loop
MachineFacts readMachine(const std::string& root, int core);

}  // namespace ballbot
