#pragma once

#include "model/truth.hpp"

namespace ballbot {

/// H: the frame in which a robot's references and estimates are meant. A robot that is told its
/// pose from outside lives in W. Any other calls the place where it was put down its origin and the
/// way it faced there its x axis; whoever judges it has to see the truth from there. H's z axis is
/// vertical and starts at the floor, as W's.
struct HomeFrame {
  Eigen::Vector2d p_WH = Eigen::Vector2d::Zero();  ///< [m]
  double yaw = 0;                                  ///< of H in W [rad]

  /// The truth with H in W's place: all positions, velocities, forces and attitudes.
  TruthFrame see(const TruthFrame& truth_W) const;

  Vector3 pointInW(const Vector3& p_H) const;
  Matrix3 R_WH() const;
};

}  // namespace ballbot
