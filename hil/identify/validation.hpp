#pragma once

#include <string>
#include <vector>

#include "hil/identify/balance_fit.hpp"
#include "hil/identify/loop_fit.hpp"

namespace ballbot {

/// How a fitted model does on a record that it was not fitted to.
struct Validation {
  std::string record;      ///< "blocked: spring, held out"
  std::string what;        ///< is predicted: "motor torque"
  double fit_percent = 0;  ///< 100 (1 - |measured - predicted| / |measured - its mean|)
  double growth = 0;       ///< of what is left, from the fitted to the held-out record
  bool good = false;
};

struct ValidationLimits {
  double least_fit_percent = 80;
  double most_growth = 3;
};

/// Motor torque by the balance. @param residual  that the fitted record left [N m]
Validation validateBalance(const MomentumBalance& held_out, const BalanceVector& balance,
                           double zero, double residual, const ValidationLimits& limits);

/// Deflection by the torque loop. @param residual  that the fitted record left
Validation validateLoop(const Record& held_out, const std::vector<LoopLine>& lines,
                        const DriveLoop& loop, double assumed_stiffness, double residual,
                        const ValidationLimits& limits);

/// Torque, as the drive shows it, by a response fitted without motor current.
Validation validateResponse(const Record& held_out, const std::vector<LoopLine>& lines,
                            const TorqueResponse& response, const ValidationLimits& limits);

}  // namespace ballbot
