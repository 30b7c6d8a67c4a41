#pragma once

#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "core/error.hpp"
#include "hil/bench_config.hpp"
#include "hil/can_bus.hpp"

namespace ballbot {

struct CommissionArguments {
  std::string bench_path;
  std::string record_path;  ///< "": beside the bench file
  std::string person;       ///< who signs
  bool json = false;
};

/// Commissions the bench with the person before the terminal, and writes the record if all was
/// good. @throw InputError if a node is not there or not as configured, or nobody signs
ExitCode commissionBench(const ConfigNode& tree, const CommissionArguments& arguments,
                         const std::vector<CanBus*>& buses);

/// The same on emulated drives and by an emulated person, in this process: what it looks like.
ExitCode rehearseCommission(bool json);

/// Every case that only commissioning can find, on emulated drives; a table.
ExitCode showCommissioningCases(bool json);

/// That this very bench has been commissioned, and by whom, in words for the report; emulated
/// drives need not be.
/// @param without  in a person's words why it may run without; "" if it may not
/// @throw InputError with all that has changed since
std::string requireCommissioned(const ConfigNode& tree, const BenchConfig& config,
                                const CommissionArguments& arguments, const std::string& without,
                                const std::vector<CanBus*>& buses);

}  // namespace ballbot
