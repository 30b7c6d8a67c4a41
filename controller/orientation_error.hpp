#pragma once

#include "model/state.hpp"

namespace ballbot {

/// Vector part e of the quaternion of R_desired R^T, |e| = sin(angle / 2), and its scalar part
/// eta >= 0. A small rotation delta of R in W changes it by -1/2 (eta 1 + skew(e)) delta.
struct OrientationError {
  Vector3 e;
  double eta;

  Matrix3 byRotation() const {
    Matrix3 J;
    J << eta, -e.z(), e.y(),  //
        e.z(), eta, -e.x(),   //
        -e.y(), e.x(), eta;
    return -0.5 * J;
  }
};
OrientationError orientationError(const Matrix3& R_desired, const Matrix3& R);

}  // namespace ballbot
