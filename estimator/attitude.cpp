#include "estimator/attitude.hpp"

#include <cmath>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot {

Matrix3 orthonormalized(const Matrix3& R) noexcept {
  // One Newton step towards the polar factor; its error is the square of the one it removes.
  return R * (1.5 * Matrix3::Identity() - 0.5 * R.transpose() * R);
}

Matrix3 inverseRightJacobian(const Vector3& phi) noexcept {
  const double angle2 = phi.squaredNorm();
  const double half = 0.5 * std::sqrt(angle2);
  // (1 - half cot(half)) / angle^2, by its series where that loses digits.
  const double c = half > 0.01 ? (1 - half / std::tan(half)) / angle2 : 1.0 / 12 + angle2 / 720;
  const Matrix3 S = skew(phi);
  return Matrix3::Identity() + 0.5 * S + c * S * S;
}

double unwrapped(double wrapped, double previous) noexcept {
  return wrapped + kTwoPi * std::round((previous - wrapped) / kTwoPi);
}

}  // namespace ballbot
