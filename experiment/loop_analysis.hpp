#pragma once

#include <optional>
#include <vector>

#include "controller/torque_loop.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {

/// The balancing loop of a scenario about its nominal equilibrium, in the frequency domain: how
/// the torques are weighed, what the drives do with them, and how far the loop is from instability.
struct LoopAnalysis {
  FrequencyShaping shaping;   ///< of the wheel torques; pole = zero where there is none
  JointVector torque_weight;  ///< the cost's, at frequency zero [1/(N m)^2]
  LoopDrives drives;          ///< as configured, whatever fidelity the plant has
  JointVector inertia;        ///< that each joint's torque feels, the others free [kg m^2]
  double delay = 0;           ///< of the torques in the loop [s]
  ShapedLqr law;
  LoopMargins with_ideal_drives, with_drives;

  /// One frequency of the picture.
  struct Sample {
    double omega;                  ///< [rad/s]
    std::complex<double> shaping;  ///< r
    double weight;                 ///< effective weight of the wheel torques, R |r|^2
    std::complex<double> wheel_blocked, wheel_loaded, arm_blocked;  ///< torque over wanted torque
    double loop_gain_ideal, loop_gain;  ///< of the wheels' largest locus
    double distance_ideal, distance;    ///< smallest singular value of 1 + L at the wheels
  };
  std::vector<Sample> samples;
};

/// @param at     when the tasks' weights are read
/// @param delay  instead of the one that follows from the scenario's rates: half a tracker period
///               and the drives' transport delay where the tracker applies the law's own feedback,
///               else plan latency and half a planning period
/// @throw InputError if the law has no such cost; NumericalError if the weights leave the ball's
/// way
///        without a price.
LoopAnalysis analyseLoop(const RunConfig& config, SimTime at,
                         const std::optional<SimDuration>& delay = std::nullopt);

}  // namespace ballbot
