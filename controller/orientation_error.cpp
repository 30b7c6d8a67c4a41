#include "controller/orientation_error.hpp"

#include <Eigen/Geometry>

namespace ballbot {

OrientationError orientationError(const Matrix3& R_desired, const Matrix3& R) {
  const Eigen::Quaterniond delta(Matrix3(R_desired * R.transpose()));
  const double sign = delta.w() < 0 ? -1 : 1;
  return {sign * delta.vec(), sign * delta.w()};
}

}  // namespace ballbot
