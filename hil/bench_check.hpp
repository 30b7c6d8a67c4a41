#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/can_bus.hpp"

namespace ballbot {

/// What one node says about itself.
struct NodeReport {
  std::string name;  ///< "wheel 1", "IMU"
  int bus = 0, node = 0;
  std::string data_sheet;  ///< "drive.eds: ballbot, emulated drive"; "" if none is named
  bool found = false, is_drive = false;
  // Nothing where the node has not given it.
  std::optional<std::string> device, firmware;
  std::optional<std::int64_t> vendor, product, serial, error_register;
  // Drives only; as the drive has them.
  std::optional<double> rated_torque_Nm, max_torque_Nm, supply_V;
  std::optional<std::int64_t> encoder_counts;
  std::optional<double> temperature_degC;  ///< object 2000, where the drive has one
  std::optional<std::string> state;        ///< of the power state machine
  std::string last_error;                  ///< 603F in words, "" for none
  /// Objects that were not given, and why: "6079:00 supply voltage: no answer within 500 ms".
  std::vector<std::string> not_given;
  /// What does not agree with the configuration; empty if all does.
  std::vector<std::string> disagreements;
};

/// It says that it is one of the emulator's, which can hurt nobody.
bool isEmulated(const NodeReport& node) noexcept;

/// Asks every node of the bench what it is, by SDO uploads only: nothing is written, nothing is
/// reset, no NMT command, no SYNC. Nodes that were running go on running. For each answer the
/// `sdo_timeout_ms` of the configuration is waited.
std::vector<NodeReport> checkBench(const BenchConfig& config, const std::vector<CanBus*>& buses);

}  // namespace ballbot
