#pragma once

#include <complex>

#include "model/actuator_parameters.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {

/// Spring torque over wanted torque of one series elastic actuator with linear friction, at a
/// frequency omega > 0 [rad/s]: docs/theory/actuator.md, eq. 6 and 7.
class ActuatorResponse {
 public:
  /// @param drive_period  tick of the drive's torque loop [s]; its sample and hold is half a tick
  ///                      of delay. Zero: a loop in continuous time.
  ActuatorResponse(const ActuatorParameters& actuator, double drive_period)
      : p_(actuator), half_tick_(drive_period / 2) {}

  /// With the output held still.
  std::complex<double> blocked(double omega) const { return at(omega, 0); }
  /// With an inertia on the output that nothing else holds. @param inertia [kg m^2]
  std::complex<double> loaded(double omega, double inertia) const { return at(omega, 1 / inertia); }

  /// Frequency above which the blocked response stays below -3 dB [rad/s]. The blocked response has
  /// at most one peak, so this is where it falls through 1/sqrt(2).
  double bandwidth() const;

 private:
  std::complex<double> at(double omega, double one_over_inertia) const;

  ActuatorParameters p_;
  double half_tick_;
};

/// The `torque_bandwidth` [Hz] with which an actuator like `p`, output blocked, measures -3 dB
/// there: by its encoders, which see the spring's deflection and not the torque of the spring's
/// damping.
/// @throw NumericalError if no drive of this motor and spring has it
double torqueBandwidthFor(ActuatorParameters p, double drive_period, double measured_bandwidth_Hz);

/// The inertia that each joint's torque feels while all other joints are free to move [kg m^2].
JointVector freeInertia(const ReducedDynamics& dynamics, const PositionVector& q);

}  // namespace ballbot
