#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace ballbot {

/// One point of a measured frequency response.
struct ResponsePoint {
  double frequency_Hz = 0;
  std::complex<double> value;
};

/// A drive's torque response: unit gain at rest, of first or second order, with a delay.
///
///   first order   G(s) = e^(-s T) w / (s + w)
///   second order  G(s) = e^(-s T) w^2 / (s^2 + 2 D w s + w^2)
struct TorqueResponse {
  int order = 2;
  double natural_frequency = 250;  ///< w [rad/s]
  double damping_ratio = 0.7;      ///< D, of the second order
  double delay = 0;                ///< T [s]
  // Standard deviations of the three, from the fit's residual.
  double natural_frequency_sigma = 0, damping_ratio_sigma = 0, delay_sigma = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of log w, D, T
  double residual = 0;  ///< rms of the complex error, relative to the unit gain at rest

  std::complex<double> at(double frequency_Hz) const;
  /// Between commands that are held for `period` and samples at the same instants, as a bus gives
  /// them: G with a hold, folded at the sampling frequency.
  std::complex<double> sampledAt(double frequency_Hz, double period) const;
  /// Frequency at which the gain has fallen to 1/sqrt(2) [Hz].
  double bandwidth_Hz() const;
  double bandwidth_sigma_Hz() const;
  double bandwidth_delay_correlation() const;
};

/// Least squares fit (Gauss-Newton) of the sampled response.
/// @param period of the bus cycle [s]
/// @throw NumericalError if the points do not determine the response.
TorqueResponse fitTorqueResponse(const std::vector<ResponsePoint>& points, int order,
                                 double period);

}  // namespace ballbot
