#pragma once

#include "hil/identify/momentum_balance.hpp"
#include "hil/identify/spectrum.hpp"

namespace ballbot {

/// What is unknown of a drive's torque loop.
enum LoopIndex : int {
  kLogGain,  ///< ln(1 + Kp)
  kGainD,    ///< Kd [s]
  kLag,      ///< T_L, of current loop and sampling, first order [s]
  kDelay,    ///< T_d, dead time of commands [s]
  kLoopCount,
};
using LoopVector = Eigen::Matrix<double, kLoopCount, 1>;

/// A drive that closes a torque loop over its spring, output blocked, friction but the viscous left
/// out (docs/theory/actuator.md, eq. 5 and 6, with a dead time of its commands):
///
///   tau_m = L [(1 + Kp) e^(-s T_d) tau_d - k_0 (Kp + Kd s) delta],   L = 1 / (1 + s T_L)
///   D delta = L (1 + Kp) e^(-s T_d) tau_d,   D = J s^2 + (B + b) s + k + L k_0 (Kp + Kd s)
///
/// delta is the spring's deflection and k_0 the stiffness the drive believes in.
class DriveLoop {
 public:
  DriveLoop(const BalanceVector& balance, const LoopVector& loop, double assumed_stiffness)
      : p_(balance), q_(loop), k0_(assumed_stiffness) {}

  /// D [N m/rad], at s = j 2 pi f.
  Complex impedance(double frequency_Hz) const;
  /// delta / tau_d [rad/(N m)].
  Complex deflection(double frequency_Hz) const;
  /// tau_m / tau_d.
  Complex motorTorque(double frequency_Hz) const;
  /// What the drive's encoders show as torque, over tau_d.
  Complex shown(double frequency_Hz) const { return k0_ * deflection(frequency_Hz); }
  /// Frequency above which shown() stays below 1/sqrt(2) [Hz].
  double bandwidth_Hz() const;

  /// Motor torque over a torque of friction on the rotor.
  Complex againstFriction(double frequency_Hz) const;

  /// deflection() between commands that are held for `period` and samples at the same instants.
  Complex sampledDeflection(double frequency_Hz, double period) const;
  /// motorTorque() between such commands and its means over a period, sampled at its end.
  Complex sampledMotorTorque(double frequency_Hz, double period) const;
  /// What of that comes from images of the held command at other frequencies: a sampled mean
  /// cannot tell them from the torque at the frequency itself.
  Complex torqueImages(double frequency_Hz, double period) const;
  /// againstFriction(), by means over a period at its end.
  Complex meanAgainstFriction(double frequency_Hz, double period) const;

 private:
  Complex lag(double frequency_Hz) const;
  Complex command(double frequency_Hz) const;

  BalanceVector p_;
  LoopVector q_;
  double k0_;
};

}  // namespace ballbot
