#pragma once

#include "estimator/external_pose.hpp"
#include "estimator/residuals.hpp"
#include "estimator/rest_alignment.hpp"

namespace ballbot {

class ConfigVisitor;

/// One standard deviation of what is known before any measurement.
struct InitialUncertainty {
  double position = 1e-4;             ///< of px = py = 0, which is a definition [m]
  double yaw = 1e-4;                  ///< of yaw = 0, likewise [rad]
  double tilt = 0.17453292519943295;  ///< 10 degrees [rad]
  double velocity_at_rest = 1e-3;     ///< [m/s]
  double omega_at_rest = 1e-3;        ///< [rad/s]
  double velocity_unknown = 0.3;      ///< where no rest was seen [m/s]
  double omega_unknown = 0.5;         ///< likewise [rad/s]
  double accel_bias = 0.03;           ///< turn-on [m/s^2]
  double gyro_bias = 3e-3;            ///< turn-on [rad/s]

  void describe(ConfigVisitor& v);
};

struct InitialEstimate {
  FilterState x;
  TangentMatrix information = TangentMatrix::Identity();
};

/// State and information after `rest`: tilt and gyroscope bias as measured, with what rest cannot
/// tell apart, tilt and horizontal accelerometer bias, left correlated. With `at_rest` false the
/// samples were taken in motion and count for little.
/// @param gravity [m/s^2]
InitialEstimate initialEstimate(const RestAlignment& rest, bool at_rest,
                                const InitialUncertainty& prior, const FilterNoise& noise,
                                double imu_period_s, double gravity) noexcept;

/// Poses seen at rest say where the robot stands, in place of the definition px = py = yaw = 0 and
/// its uncertainty. Nothing changes if there were none.
void placeAt(const RestPose& pose, const ExternalPoseSettings& settings,
             InitialEstimate& estimate) noexcept;

}  // namespace ballbot
