#pragma once

#include <vector>

#include <Eigen/Core>

#include "controller/vector_kernels.hpp"

namespace ballbot {

/// Linear-quadratic approximation of one stage about a nominal (x, u), in deviations:
///
///   dx+ = A dx + B du + b,
///   L = 1/2 dx^T Q dx + q^T dx + du^T P dx + 1/2 du^T R du + r^T du + c.
///
/// Stored as one matrix per term of the augmented state (dx, 1), padded to whole registers, in the
/// order in which the sweep reads it. Q and R are stored whole. A new stage is zero, with ones
/// where padding needs them; set each part through its view.
template <int NX, int NU>
struct LqStage {
  static_assert(NX > 1 && NU > 1, "the row-major views need more than one column");
  static constexpr int kX = roundUpTo4(NX + 1);  ///< (dx, 1), padded
  static constexpr int kU = roundUpTo4(NU);
  static constexpr int kZ = kX + kU;  ///< ((dx, 1), du)

  template <int R, int C, int kOrder, int kStride>
  using View = Eigen::Map<Eigen::Matrix<double, R, C, kOrder>, 0, Eigen::OuterStride<kStride>>;
  template <int R, int kStride>
  using Strided = Eigen::Map<Eigen::Matrix<double, R, 1>, 0, Eigen::InnerStride<kStride>>;

  LqStage();

  auto A() { return View<NX, NX, Eigen::RowMajor, kZ>(Ft); }
  auto B() { return View<NX, NU, Eigen::RowMajor, kZ>(Ft + kX); }
  auto b() { return Strided<NX, kZ>(Ft + NX); }
  auto Q() { return View<NX, NX, Eigen::ColMajor, kX>(Wxx); }
  auto q() { return Strided<NX, kX>(Wxx + NX); }
  auto Pt() { return View<NX, NU, Eigen::ColMajor, kX>(Wxu); }  ///< P^T
  auto R() { return View<NU, NU, Eigen::ColMajor, kU>(Wuu); }
  auto r() { return Strided<NU, kX>(Wxu + NX); }
  /// Makes this the expansion of a differential equation: the augmented 1 has no rate.
  void forRates() { Ft[NX * kZ + NX] = 0; }
  void setConstant(double c) { Wxx[NX * kX + NX] = 2 * c; }

  alignas(32) double Ft[kX * kZ];   ///< column k: row k of [A b B]
  alignas(32) double Wxx[kX * kX];  ///< [Q q; q^T 2c], lower triangle used
  alignas(32) double Wxu[kX * kU];  ///< [P^T; r^T]
  alignas(32) double Wuu[kU * kU];  ///< R, lower triangle used
};

/// du = k + K dx, stored so that the product with (dx, 1) runs over whole registers.
template <int NX, int NU>
struct StageGain {
  static constexpr int kX = roundUpTo4(NX + 1);
  static constexpr int kU = roundUpTo4(NU);

  using GainMap = Eigen::Map<Eigen::Matrix<double, NU, NX>, 0, Eigen::OuterStride<kU>>;
  using StepMap = Eigen::Map<Eigen::Matrix<double, NU, 1>>;
  auto K() { return GainMap(Kk); }
  auto k() { return StepMap(Kk + NX * kU); }
  auto K() const {
    return Eigen::Map<const Eigen::Matrix<double, NU, NX>, 0, Eigen::OuterStride<kU>>(Kk);
  }
  auto k() const { return Eigen::Map<const Eigen::Matrix<double, NU, 1>>(Kk + NX * kU); }

  alignas(32) double Kk[kU * kX] = {};  ///< [K k 0]
};

/// Value of an optimal continuation, V = 1/2 dx^T S dx + s^T dx + c.
template <int NX>
struct ValueFunction {
  static constexpr int kX = roundUpTo4(NX + 1);

  ValueFunction();
  auto S() const {
    return Eigen::Map<const Eigen::Matrix<double, NX, NX>, 0, Eigen::OuterStride<kX>>(S_aug);
  }
  auto s() const { return Eigen::Map<const Eigen::Matrix<double, NX, 1>>(S_aug + NX * kX); }
  double constant() const { return 0.5 * S_aug[NX * kX + NX]; }
  /// Sets all of it from S, s and c.
  void set(const Eigen::Matrix<double, NX, NX>& S, const Eigen::Matrix<double, NX, 1>& s, double c);

  alignas(32) double S_aug[kX * kX];  ///< [S s; s^T 2c], whole
};

/// One step of the discrete Riccati recursion: from the value after the stage to the value before
/// it, and the stage's optimal gain. With H = R + shift 1 + B^T S B, G = P + B^T S A:
///
///   K = -H^-1 G,  S <- Q + A^T S A - G^T H^-1 G   (and the affine terms with it).
///
/// @return false if H is not positive definite or not finite; value and gain are then of no use.
template <int NX, int NU>
[[nodiscard]] bool riccatiStep(const LqStage<NX, NU>& stage, double shift, ValueFunction<NX>& value,
                               StageGain<NX, NU>& gain) noexcept;

/// The continuous recursion, backward in time: with A and B of dx/dt = A dx + B du, costs as rates,
/// and (1, 1) of the augmented A zero (see LqStage::forRates),
///
///   dS/d(-t) = Q + A^T S + S A - G^T R^-1 G,  G = P + B^T S,
///
/// on the augmented value [S s; s^T 2c], whole and symmetric. False if R + shift 1 is not positive
/// definite.
template <int NX, int NU>
[[nodiscard]] bool riccatiRate(const LqStage<NX, NU>& rates, double shift, const double* S_aug,
                               double* dS_aug) noexcept;
/// K = -R^-1 G and k = -R^-1 (r + B^T s) of the same.
template <int NX, int NU>
[[nodiscard]] bool riccatiRateGain(const LqStage<NX, NU>& rates, double shift,
                                   const double* S_aug, StageGain<NX, NU>& gain) noexcept;

}  // namespace ballbot
