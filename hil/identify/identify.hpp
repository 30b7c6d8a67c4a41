#pragma once

#include <string>
#include <vector>

#include "hil/identify/figures.hpp"
#include "hil/identify/validation.hpp"

namespace ballbot {

/// What the fit is told about the drive, and how it is judged.
struct IdentifyOptions {
  double assumed_stiffness = 350;  ///< of the spring, as the drive believes it [N m/rad]
  double least_speed = 0.15;       ///< of the rotor, below which friction is no constant [rad/s]
  ValidationLimits limits;
};

struct Identification {
  bool has_current = false;  ///< the drive shows its motor's current; else its response is all
  Figures figures;
  BalanceFit balance;  ///< only with current
  LoopFit loop;        ///< only with current
  /// Torque as the drive shows it over torque sent, output blocked; with current: as it would be
  /// without dry friction and backlash.
  std::vector<ResponsePoint> points;
  TorqueResponse first, second;  ///< fitted to them
  std::vector<Validation> validation;

  bool valid() const;
  /// Which held-out record the model does not fit, in words; "" if valid.
  std::string complaint() const;
};

/// Identifies a drive from its records; pure. Friction, rotor and spring need the motor's current:
/// without it the response alone is found.
/// @throw NumericalError if the records do not determine the model; InputError if records are
/// missing
Identification identify(const std::vector<Record>& records, const IdentifyOptions& options);

}  // namespace ballbot
