#pragma once

#include <vector>

#include "hil/identify/drive_loop.hpp"
#include "hil/identify/torque_response.hpp"

namespace ballbot {

/// A blocked record in steady state, by frequency: means over its periods.
struct LoopLine {
  double frequency_Hz = 0;
  Complex sent;        ///< [N m]
  Complex shown;       ///< torque, as the drive says [N m]
  Complex deflection;  ///< [rad]
  Complex motor;       ///< motor torque [N m]
  Complex nonlinear;   ///< dry friction and what backlash takes off the spring [N m]
};

/// A blocked, repeating record by the lines that its excitation has, and between its samples, since
/// friction turns over wherever the rotor does.
class ResponseRecord {
 public:
  explicit ResponseRecord(const Record& record);

  /// @param zero  of its deflection [rad]
  std::vector<LoopLine> lines(const BalanceVector& balance, double zero) const;

 private:
  std::vector<double> nonlinearTorque(const BalanceVector& balance, double zero) const;

  std::vector<int> numbers_;                          ///< of the lines
  std::vector<LoopLine> linear_;                      ///< with no nonlinear torque yet
  std::vector<double> velocity_, deflection_, rate_;  ///< at fine instants of a period
};

/// Of all records, by frequency.
std::vector<LoopLine> linesOf(const std::vector<ResponseRecord>& records,
                              const BalanceVector& balance, double zero);

struct LoopFit {
  LoopVector value = LoopVector::Zero();
  Eigen::Matrix<double, kLoopCount, kLoopCount> covariance =
      Eigen::Matrix<double, kLoopCount, kLoopCount>::Zero();
  /// d(value) / d(balance): how errors of what was assumed known go on.
  Eigen::Matrix<double, kLoopCount, kBalanceCount> sensitivity =
      Eigen::Matrix<double, kLoopCount, kBalanceCount>::Zero();
  double shown_residual = 0, motor_residual = 0;  ///< of both LoopErrors, rms of a part [N m]
};

/// Least squares of deflection and motor torque by the records' torque and friction, each weighed
/// by its residual. @param zero  of the deflection [rad]
/// @throw NumericalError if they do not determine the loop.
LoopFit fitLoop(const std::vector<ResponseRecord>& records, const BalanceVector& balance,
                double zero, double assumed_stiffness, double period);

/// Predicted minus measured [N m].
struct LoopError {
  Complex shown;  ///< deflection times the assumed stiffness
  Complex motor;  ///< motor torque
};
LoopError loopError(const LoopLine& line, const DriveLoop& loop, double assumed_stiffness,
                    double period);

/// What the lines' deflection would be without friction and backlash, as torque over torque sent.
std::vector<ResponsePoint> linearPoints(const std::vector<LoopLine>& lines, const DriveLoop& loop,
                                        double assumed_stiffness);

/// What torqueImages() make of a blocked, repeating record: to be taken off its motor torque.
std::vector<double> torqueImagesOf(const Record& record, const DriveLoop& loop);

}  // namespace ballbot
