#pragma once

#include <Eigen/Core>

#include "model/sine_cosine.hpp"

namespace ballbot {

/// Four doubles that go through the same arithmetic, one per lane of an AVX2 register: the scalar
/// with which the templates of model/ treat four states at once. No lane depends on another.
struct Pack {
  static constexpr int kLanes = 4;
  typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));

  typedef double Unaligned
      __attribute__((vector_size(kLanes * sizeof(double)), aligned(sizeof(double)), may_alias));

  Lanes lanes;

  Pack() = default;
  Pack(double all) : lanes{all, all, all, all} {}  // implicit: constants are doubles
  explicit Pack(Lanes l) : lanes(l) {}

  static Pack load(const double* from) { return Pack(*reinterpret_cast<const Unaligned*>(from)); }
  void store(double* to) const { *reinterpret_cast<Unaligned*>(to) = lanes; }

  Pack operator-() const { return Pack(-lanes); }
  Pack& operator+=(const Pack& o) { return lanes += o.lanes, *this; }
  Pack& operator-=(const Pack& o) { return lanes -= o.lanes, *this; }
  Pack& operator*=(const Pack& o) { return lanes *= o.lanes, *this; }
  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.lanes + b.lanes); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.lanes - b.lanes); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.lanes * b.lanes); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.lanes / b.lanes); }
};

/// Rows and columns of a 4 x 4 block change places.
inline void transpose(Pack (&rows)[4]) {
  typedef long long Pick __attribute__((vector_size(32)));
  constexpr Pick kEven = {0, 4, 2, 6}, kOdd = {1, 5, 3, 7}, kLow = {0, 1, 4, 5},
                 kHigh = {2, 3, 6, 7};
  const Pack::Lanes a = __builtin_shuffle(rows[0].lanes, rows[1].lanes, kEven);
  const Pack::Lanes b = __builtin_shuffle(rows[0].lanes, rows[1].lanes, kOdd);
  const Pack::Lanes c = __builtin_shuffle(rows[2].lanes, rows[3].lanes, kEven);
  const Pack::Lanes d = __builtin_shuffle(rows[2].lanes, rows[3].lanes, kOdd);
  rows[0].lanes = __builtin_shuffle(a, c, kLow);
  rows[1].lanes = __builtin_shuffle(b, d, kLow);
  rows[2].lanes = __builtin_shuffle(a, c, kHigh);
  rows[3].lanes = __builtin_shuffle(b, d, kHigh);
}

/// N values of each lane: lane l reads from[l][0] to from[l][N - 1].
template <int N>
void gather(const double* const (&from)[Pack::kLanes], Pack* to) {
  int i = 0;
  for (; i + 4 <= N; i += 4) {
    Pack block[4] = {Pack::load(from[0] + i), Pack::load(from[1] + i), Pack::load(from[2] + i),
                     Pack::load(from[3] + i)};
    transpose(block);
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) to[i + k] = block[k];
  }
  for (; i < N; ++i) to[i] = Pack(Pack::Lanes{from[0][i], from[1][i], from[2][i], from[3][i]});
}

/// The reverse: lane l writes to[l][0] to to[l][N - 1].
template <int N>
void scatter(const Pack* from, double* const (&to)[Pack::kLanes]) {
  int i = 0;
  for (; i + 4 <= N; i += 4) {
    Pack block[4] = {from[i], from[i + 1], from[i + 2], from[i + 3]};
    transpose(block);
#pragma GCC unroll 4
    for (int l = 0; l < 4; ++l) block[l].store(to[l] + i);
  }
  for (; i < N; ++i) {
    for (int l = 0; l < 4; ++l) to[l][i] = from[i].lanes[l];
  }
}

/// Of kCount angles, four lanes each; the arrays have room for whole pairs.
template <int kCount>
void sinesAndCosines(const Pack* angle, Pack* sine, Pack* cosine) {
  for (int i = 0; i < kCount; i += 2) {
    double a[8], s[8], c[8];
    for (int k = 0; k < 2; ++k) angle[i + k].store(a + 4 * k);
    sineCosine8(a, s, c);
    for (int k = 0; k < 2; ++k) {
      sine[i + k] = Pack::load(s + 4 * k);
      cosine[i + k] = Pack::load(c + 4 * k);
    }
  }
}

}  // namespace ballbot

namespace Eigen {
template <>
struct NumTraits<ballbot::Pack> : GenericNumTraits<ballbot::Pack> {
  using Real = ballbot::Pack;
  using NonInteger = ballbot::Pack;
  using Nested = ballbot::Pack;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}  // namespace Eigen
