#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/can_bus.hpp"

namespace ballbot {

/// What one node says about itself.
struct NodeReport {
  std::string name;  ///< "wheel 1", "IMU"
  int bus = 0, node = 0;
  bool found = false;
  std::string device, firmware;
  std::uint32_t vendor = 0, product = 0, serial = 0;
  // Drives only; as the drive has them.
  double rated_torque_Nm = 0, max_torque_Nm = 0;
  std::int64_t encoder_counts = 0;
  double supply_V = 0;
  double temperature_degC = 0;  ///< object 2000, where the drive has one
  std::string state;            ///< of the power state machine
  std::string last_error;       ///< 603F in words, "" for none
  std::int64_t error_register = 0;
  /// What does not agree with the configuration; empty if all does.
  std::vector<std::string> disagreements;
};

/// It says that it is one of the emulator's, which can hurt nobody.
bool isEmulated(const NodeReport& node) noexcept;

/// Asks every node of the bench what it is, by SDO uploads only: nothing is written, nothing is
/// reset, no NMT command, no SYNC. Nodes that were running go on running.
std::vector<NodeReport> checkBench(const BenchConfig& config, const std::vector<CanBus*>& buses,
                                   std::chrono::milliseconds patience);

}  // namespace ballbot
