#pragma once

#include <optional>
#include <vector>

#include "controller/torque_loop.hpp"
#include "experiment/loop_margins.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {

/// The balancing loop of a scenario about its nominal equilibrium: how far the loop that runs is
/// from instability, and, as a picture of it in continuous time and the frequency domain, how the
/// torques are weighed, what the drives do with them, and where the loop gain crosses 1.
struct LoopAnalysis {
  SampledMargins margins;  ///< of the law, the rates and the plant in force
  SimDuration period{};    ///< after which all that acts in that loop comes again

  // The picture. Its law is the Riccati equation's for the law's cost.
  FrequencyShaping shaping;   ///< of the wheel torques; pole = zero where there is none
  JointVector torque_weight;  ///< the cost's, at frequency zero [1/(N m)^2]
  LoopDrives drives;          ///< as configured, whatever fidelity the plant has
  JointVector inertia;        ///< that each joint's torque feels, the others free [kg m^2]
  double delay = 0;           ///< of the torques in it [s]
  ShapedLqr law;
  LoopShape with_ideal_drives, with_drives;

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
/// @param delay  of the picture, instead of the one that follows from the scenario's rates: half a
///               tracker period and the drives' transport delay where the tracker applies the law's
///               own feedback, else plan latency and half a planning period
/// @throw InputError if the law has no such cost, or the rates do not come together; NumericalError
///        if the weights leave the ball's way without a price, or the law cannot plan from rest.
LoopAnalysis analyseLoop(const RunConfig& config, SimTime at,
                         const std::optional<SimDuration>& delay = std::nullopt);

}  // namespace ballbot
