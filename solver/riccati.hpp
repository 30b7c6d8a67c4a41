#pragma once

#include <Eigen/Core>

#include "solver/strided_view.hpp"
#include "solver/vector_kernels.hpp"

// Definitions are in riccati_impl.hpp, for whoever instantiates sizes of their own.

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
  static_assert(NX >= 1 && NU >= 1, "a stage has at least one state and one input");
  static constexpr int kX = roundUpTo4(NX + 1);  ///< (dx, 1), padded
  static constexpr int kU = roundUpTo4(NU);
  static constexpr int kZ = kX + kU;  ///< ((dx, 1), du)

  LqStage();

  auto A() { return StridedView<NX, NX, kZ, 1>(Ft); }
  auto B() { return StridedView<NX, NU, kZ, 1>(Ft + kX); }
  auto b() { return StridedView<NX, 1, kZ, 1>(Ft + NX); }
  auto Q() { return StridedView<NX, NX, 1, kX>(Wxx); }
  auto q() { return StridedView<NX, 1, kX, 1>(Wxx + NX); }
  auto Pt() { return StridedView<NX, NU, 1, kX>(Wxu); }  ///< P^T
  auto R() { return StridedView<NU, NU, 1, kU>(Wuu); }
  auto r() { return StridedView<NU, 1, kX, 1>(Wxu + NX); }
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

  auto K() { return StridedView<NU, NX, 1, kU>(Kk); }
  auto k() { return Eigen::Map<Eigen::Matrix<double, NU, 1>>(Kk + NX * kU); }
  auto K() const { return ConstStridedView<NU, NX, 1, kU>(Kk); }
  auto k() const { return Eigen::Map<const Eigen::Matrix<double, NU, 1>>(Kk + NX * kU); }

  alignas(32) double Kk[kU * kX] = {};  ///< [K k 0]
};

/// Value of an optimal continuation, V = 1/2 dx^T S dx + s^T dx + c.
template <int NX>
struct ValueFunction {
  static constexpr int kX = roundUpTo4(NX + 1);

  ValueFunction();
  auto S() const { return ConstStridedView<NX, NX, 1, kX>(S_aug); }
  auto s() const { return Eigen::Map<const Eigen::Matrix<double, NX, 1>>(S_aug + NX * kX); }
  double constant() const { return 0.5 * S_aug[NX * kX + NX]; }
  /// Sets all of it from S, s and c.
  void set(const Eigen::Matrix<double, NX, NX>& S, const Eigen::Matrix<double, NX, 1>& s, double c);

  alignas(32) double S_aug[kX * kX];  ///< [S s; s^T 2c], whole
};

// The kernels are never inlined: then their sums are contracted to the same multiply-adds in every
// program that has them, and equal inputs give equal bits.

/// One step of the discrete Riccati recursion: from the value after the stage to the value before
/// it, and the stage's optimal gain. With H = R + shift 1 + B^T S B, G = P + B^T S A:
///
///   K = -H^-1 G,  S <- Q + A^T S A - G^T H^-1 G   (and the affine terms with it).
///
/// @return false if H is not positive definite or not finite; value and gain are then of no use.
template <int NX, int NU>
[[nodiscard, gnu::noinline]] bool riccatiStep(const LqStage<NX, NU>& stage, double shift,
                                              ValueFunction<NX>& value,
                                              StageGain<NX, NU>& gain) noexcept;

/// The continuous recursion, backward in time: with A and B of dx/dt = A dx + B du, costs as rates,
/// and (1, 1) of the augmented A zero (see LqStage::forRates),
///
///   dS/d(-t) = Q + A^T S + S A - G^T R^-1 G,  G = P + B^T S,
///
/// on the augmented value [S s; s^T 2c], whole and symmetric. False if R + shift 1 is not positive
/// definite.
template <int NX, int NU>
[[nodiscard, gnu::noinline]] bool riccatiRate(const LqStage<NX, NU>& rates, double shift,
                                              const double* S_aug, double* dS_aug) noexcept;
/// K = -R^-1 G and k = -R^-1 (r + B^T s) of the same.
template <int NX, int NU>
[[nodiscard, gnu::noinline]] bool riccatiRateGain(const LqStage<NX, NU>& rates, double shift,
                                                  const double* S_aug,
                                                  StageGain<NX, NU>& gain) noexcept;

}  // namespace ballbot
