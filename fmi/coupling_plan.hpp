#pragma once

#include <vector>

#include "fmi/coupling_graph.hpp"
#include "fmi/fmu_process.hpp"
#include "model/added_signals.hpp"

namespace ballbot {

/// How a scenario's plant and its FMUs work together: all that can be known, and be wrong, before
/// any of them runs.
struct CouplingPlan {
  CouplingGraph graph;
  std::vector<FmuUse> fmus;       ///< of the graph's nodes of the same names
  bool native_plant = true;       ///< no FMU stands in the plant's place
  bool has_truth = false;         ///< the true state can go on record
  std::vector<bool> added_truth;  ///< and which of AddedTruth::list()

  /// Whether all of these can.
  bool feeds(const AddedSignals& truth) const;
};

/// Completes the connections by names: what the plant's FMU calls like the signals of the messages
/// (command.torque, sensors.gyro_WB_B, truth.p_WE, ...) needs no line in the scenario.
/// @throw InputError with file, line and column.
CouplingPlan planCoupling(const ConfigNode& scenario);

}  // namespace ballbot
