#pragma once

#include <algorithm>
#include <cmath>

#include "solver/riccati.hpp"

namespace ballbot {
namespace detail {

/// T = S F, for the first `kColumns` columns of F beginning at row `Ft` of its transpose.
template <int kX, int kZ, int kColumns>
void multiplyColumns(const double* S, const double* Ft, double* T) {
  constexpr int kRows4 = kX / 4;
  constexpr int kBlock = kRows4 <= 3 ? 4 : 2;
  constexpr int kWhole = kColumns / kBlock * kBlock;
  for (int j = 0; j < kWhole; j += kBlock) {
    Tile<kRows4, kBlock> tile;
    tile.setZero();
    tile.addProduct(S, kX, Ft + j, kZ, 1, kX);
    tile.store(T + j * kX, kX);
  }
  for (int j = kWhole; j < kColumns; ++j) {
    Tile<kRows4, 1> tile;
    tile.setZero();
    tile.addProduct(S, kX, Ft + j, kZ, 1, kX);
    tile.store(T + j * kX, kX);
  }
}

/// Lower triangle, in 4 x 4 blocks, of C = W + F^T T - Y^T Y; recursion over block columns.
template <int kX, int kZ, int kU, int kJ = 0>
void updateLowerTriangle(const double* W, const double* Ft, const double* T, const double* Yt,
                         double* C) {
  if constexpr (kJ < kX / 4) {
    constexpr int kRows4 = kX / 4 - kJ;
    constexpr int kBlock = kRows4 <= 3 ? 4 : 2;
    for (int j = 4 * kJ; j < 4 * kJ + 4; j += kBlock) {
      Tile<kRows4, kBlock> tile;
      tile.load(W + j * kX + 4 * kJ, kX);
      tile.addProduct(Ft + 4 * kJ, kZ, T + j * kX, 1, kX, kX);
      tile.subtractProduct(Yt + 4 * kJ, kX, Yt + j, kX, 1, kU);
      tile.store(C + j * kX + 4 * kJ, kX);
    }
    updateLowerTriangle<kX, kZ, kU, kJ + 1>(W, Ft, T, Yt, C);
  }
}

/// L L^T = H in place, lower triangle. Padding rows of H must be zero. False if not positive.
template <int kU, int NU>
bool factorise(double* H, double* inverse_diagonal) {
  constexpr int kRows4 = kU / 4;
  for (int j = 0; j < NU; ++j) {
    Tile<kRows4, 1> column;
    column.load(H + j * kU, kU);
    column.subtractProduct(H, kU, H + j, kU, 0, j);
    column.store(H + j * kU, kU);
    const double pivot = H[j * kU + j];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    const double scale = 1 / std::sqrt(pivot);
    inverse_diagonal[j] = scale;
    for (int i = 0; i < kRows4; ++i) store4(H + j * kU + 4 * i, column.sum[0][i] * scale);
  }
  return true;
}

/// Y^T = X L^-T, in place in X (kX x NU).
template <int kX, int kU, int NU>
void solveFromTheRight(const double* L, const double* inverse_diagonal, double* X) {
  constexpr int kRows4 = kX / 4;
  for (int j = 0; j < NU; ++j) {
    Tile<kRows4, 1> column;
    column.load(X + j * kX, kX);
    column.subtractProduct(X, kX, L + j, kU, 0, j);
    for (int i = 0; i < kRows4; ++i)
      store4(X + j * kX + 4 * i, column.sum[0][i] * inverse_diagonal[j]);
  }
}

/// K^T = -Y^T L^-1, column by column from the last.
template <int kX, int kU, int NU, int NX>
void gainFrom(const double* Yt, const double* L, const double* inverse_diagonal,
              StageGain<NX, NU>& gain) {
  constexpr int kRows4 = kX / 4;
  alignas(32) double Kt[kX * kU];
  for (int j = NU - 1; j >= 0; --j) {
    Tile<kRows4, 1> column;
    column.load(Yt + j * kX, kX);
    column.addProduct(Kt + (j + 1) * kX, kX, L + j * kU + j + 1, 1, 0, NU - 1 - j);
    for (int i = 0; i < kRows4; ++i)
      store4(Kt + j * kX + 4 * i, -column.sum[0][i] * inverse_diagonal[j]);
  }
  for (int i = 0; i <= NX; ++i)
    for (int j = 0; j < NU; ++j) gain.Kk[i * kU + j] = Kt[j * kX + i];
}

/// The upper triangle from the lower.
template <int kX>
void mirror(double* S) {
  for (int j = 0; j < kX; ++j)
    for (int i = j + 1; i < kX; ++i) S[i * kX + j] = S[j * kX + i];
}

/// Continuous case: factor of R + shift 1 and Y^T = G^T L^-T, G^T = P^T + S B.
template <int NX, int NU>
bool factoriseRates(const LqStage<NX, NU>& rates, double shift, const double* S, double* L,
                    double* inverse_diagonal, double* Yt) {
  using Stage = LqStage<NX, NU>;
  constexpr int kX = Stage::kX, kU = Stage::kU, kZ = Stage::kZ;
  std::copy(std::begin(rates.Wuu), std::end(rates.Wuu), L);
  for (int j = 0; j < NU; ++j) {
    L[j * kU + j] += shift;
    Tile<kX / 4, 1> tile;
    tile.load(rates.Wxu + j * kX, kX);
    tile.addProduct(S, kX, rates.Ft + kX + j, kZ, 0, kX);
    tile.store(Yt + j * kX, kX);
  }
  if (!factorise<kU, NU>(L, inverse_diagonal)) return false;
  solveFromTheRight<kX, kU, NU>(L, inverse_diagonal, Yt);
  return true;
}

}  // namespace detail

template <int NX, int NU>
LqStage<NX, NU>::LqStage() {
  std::fill(std::begin(Ft), std::end(Ft), 0.0);
  std::fill(std::begin(Wxx), std::end(Wxx), 0.0);
  std::fill(std::begin(Wxu), std::end(Wxu), 0.0);
  std::fill(std::begin(Wuu), std::end(Wuu), 0.0);
  Ft[NX * kZ + NX] = 1;  // the augmented 1 stays 1
}

template <int NX>
ValueFunction<NX>::ValueFunction() {
  std::fill(std::begin(S_aug), std::end(S_aug), 0.0);
}

template <int NX>
void ValueFunction<NX>::set(const Eigen::Matrix<double, NX, NX>& S,
                            const Eigen::Matrix<double, NX, 1>& s, double c) {
  Eigen::Map<Eigen::Matrix<double, kX, kX>> whole(S_aug);
  whole.setZero();
  whole.template topLeftCorner<NX, NX>() = S;
  whole.template block<NX, 1>(0, NX) = s;
  whole.template block<1, NX>(NX, 0) = s.transpose();
  whole(NX, NX) = 2 * c;
}

template <int NX, int NU>
bool riccatiStep(const LqStage<NX, NU>& stage, double shift, ValueFunction<NX>& value,
                 StageGain<NX, NU>& gain) noexcept {
  using Stage = LqStage<NX, NU>;
  constexpr int kX = Stage::kX, kU = Stage::kU, kZ = Stage::kZ;
  constexpr int kX4 = kX / 4, kU4 = kU / 4;
  alignas(32) double T[kX * kZ];   // S [A b B]
  alignas(32) double H[kU * kU];   // then its Cholesky factor
  alignas(32) double Yt[kX * kU];  // first G^T, then (L^-1 G)^T
  double inverse_diagonal[kU];

  if constexpr (kX > NX + 1) std::fill(T + (NX + 1) * kX, T + kX * kX, 0.0);
  detail::multiplyColumns<kX, kZ, NX + 1>(value.S_aug, stage.Ft, T);
  detail::multiplyColumns<kX, kZ, NU>(value.S_aug, stage.Ft + kX, T + kX * kX);
  const double* SB = T + kX * kX;

  for (int j = 0; j < NU; ++j) {
    Tile<kU4, 1> tile;
    tile.load(stage.Wuu + j * kU, kU);
    tile.addProduct(stage.Ft + kX, kZ, SB + j * kX, 1, 0, kX);
    tile.store(H + j * kU, kU);
    H[j * kU + j] += shift;
  }
  for (int j = 0; j < NU; ++j) {
    Tile<kX4, 1> tile;
    tile.load(stage.Wxu + j * kX, kX);
    tile.addProduct(stage.Ft, kZ, SB + j * kX, 1, 0, kX);
    tile.store(Yt + j * kX, kX);
  }

  if (!detail::factorise<kU, NU>(H, inverse_diagonal)) return false;
  detail::solveFromTheRight<kX, kU, NU>(H, inverse_diagonal, Yt);
  detail::gainFrom<kX, kU, NU>(Yt, H, inverse_diagonal, gain);
  detail::updateLowerTriangle<kX, kZ, NU>(stage.Wxx, stage.Ft, T, Yt, value.S_aug);
  detail::mirror<kX>(value.S_aug);
  return true;
}

template <int NX, int NU>
bool riccatiRate(const LqStage<NX, NU>& rates, double shift, const double* S_aug,
                 double* dS_aug) noexcept {
  using Stage = LqStage<NX, NU>;
  constexpr int kX = Stage::kX, kU = Stage::kU, kZ = Stage::kZ;
  alignas(32) double S[kX * kX];  // the integrator's vectors may lie anywhere
  alignas(32) double SA[kX * kX];
  alignas(32) double L[kU * kU];
  alignas(32) double Yt[kX * kU];
  double inverse_diagonal[kU];
  std::copy_n(S_aug, kX * kX, S);
  if (!detail::factoriseRates(rates, shift, S, L, inverse_diagonal, Yt)) return false;
  if constexpr (kX > NX + 1) std::fill(SA + (NX + 1) * kX, SA + kX * kX, 0.0);
  detail::multiplyColumns<kX, kZ, NX + 1>(S, rates.Ft, SA);
  for (int j = 0; j < kX; ++j) {
    Tile<kX / 4, 1> column;
    column.load(rates.Wxx + j * kX, kX);
    column.subtractProduct(Yt, kX, Yt + j, kX, 0, NU);
    column.store(S, kX);
    for (int i = j; i < kX; ++i) dS_aug[j * kX + i] = S[i] + SA[j * kX + i] + SA[i * kX + j];
  }
  detail::mirror<kX>(dS_aug);
  return true;
}

template <int NX, int NU>
bool riccatiRateGain(const LqStage<NX, NU>& rates, double shift, const double* S_aug,
                     StageGain<NX, NU>& gain) noexcept {
  using Stage = LqStage<NX, NU>;
  constexpr int kX = Stage::kX, kU = Stage::kU;
  alignas(32) double S[kX * kX];
  alignas(32) double L[kU * kU];
  alignas(32) double Yt[kX * kU];
  double inverse_diagonal[kU];
  std::copy_n(S_aug, kX * kX, S);
  if (!detail::factoriseRates(rates, shift, S, L, inverse_diagonal, Yt)) return false;
  detail::gainFrom<kX, kU, NU>(Yt, L, inverse_diagonal, gain);
  return true;
}

}  // namespace ballbot
