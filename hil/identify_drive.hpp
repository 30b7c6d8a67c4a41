#pragma once

#include <atomic>
#include <vector>

#include "hil/bench_runner.hpp"
#include "hil/torque_response.hpp"

namespace ballbot {

/// How a drive is excited: a sum of sines with whole periods in the record, phases after Schroeder
/// so that the peak stays low, around a constant torque that keeps dry friction on one side.
struct ExcitationPlan {
  int drive = 0;
  double amplitude_Nm = 3.8;  ///< peak of the sum of sines; large against dry friction
  double bias_Nm = 0;
  double low_Hz = 2, high_Hz = 120;
  int lines = 24;       ///< frequencies, evenly spread in the logarithm
  double record_s = 2;  ///< one period of the whole signal
  int records = 3;      ///< the first settles and is thrown away
};

struct Identification {
  std::vector<ResponsePoint> points;
  TorqueResponse first, second;
  double largest_torque = 0;  ///< commanded [N m]
};

/// The same bench for a drive whose response is not known yet: its torque is not compared with one.
BenchConfig forIdentification(BenchConfig config);

/// Excites one drive of a bench, all others at zero torque, and fits its torque response.
/// @throw InputError if the plan exceeds the drive's torque limit or half the bus rate;
///        LostParticipantError if the bench stops; NumericalError if nothing can be fitted;
///        InterruptedError, with the drives off, once `stop` is set.
Identification identifyDrive(BenchRunner& runner, const ExcitationPlan& plan,
                             const std::atomic<bool>* stop = nullptr);

}  // namespace ballbot
