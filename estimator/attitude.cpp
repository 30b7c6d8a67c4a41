#include "estimator/attitude.hpp"

#include <cmath>

namespace ballbot {

Matrix3 orthonormalized(const Matrix3& R) noexcept {
  // One Newton step towards the polar factor; its error is the square of the one it removes.
  return R * (1.5 * Matrix3::Identity() - 0.5 * R.transpose() * R);
}

double unwrapped(double wrapped, double previous) noexcept {
  constexpr double kTwoPi = 6.283185307179586476925;
  return wrapped + kTwoPi * std::round((previous - wrapped) / kTwoPi);
}

}  // namespace ballbot
