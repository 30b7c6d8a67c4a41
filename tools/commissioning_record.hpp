#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/config_node.hpp"
#include "hil/bench_check.hpp"
#include "hil/commissioning/commissioning.hpp"

namespace ballbot {

/// What a person has found good, and with what: the configuration and the identity of every node.
struct CommissioningRecord {
  std::string by, at;  ///< who, and when (UTC, ISO 8601)
  /// The bench file, value by value: "drives.0.sign" and "1".
  std::vector<std::pair<std::string, std::string>> configuration;
  /// "wheel 1" and "bus 0, node 1, vendor 000002E1, product ..., serial ..., firmware ...".
  std::vector<std::pair<std::string, std::string>> nodes;
};

/// A record of now. What says nothing about the bench's wiring and drives is left out of the
/// configuration: emulator, scenario, set, realtime.
CommissioningRecord recordOf(const ConfigNode& bench, const std::vector<NodeReport>& nodes,
                             const std::string& by);

/// What is not as it was: "drives.0.sign was 1, is -1". Empty if all is.
std::vector<std::string> changesSince(const CommissioningRecord& then,
                                      const CommissioningRecord& now);

/// Beside the bench file: "bench.yaml" has "bench.commissioned.json".
std::string commissioningPath(const std::string& bench_path);

/// @throw OutputError
void writeCommissioningRecord(const std::string& path, const CommissioningRecord& record,
                              const CommissioningReport& report);
/// @throw InputError if it is not there, is damaged or was edited
CommissioningRecord readCommissioningRecord(const std::string& path);

}  // namespace ballbot
