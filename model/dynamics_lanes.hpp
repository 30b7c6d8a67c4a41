#pragma once

#include <algorithm>
#include <type_traits>

#include "model/newton_euler.hpp"
#include "model/pack.hpp"

namespace ballbot {

/// Four states, with their inputs, gathered from arrays and put through the Newton-Euler pass.
/// Where fewer than four are left the last one fills the lanes; its results are written again.
template <bool kSpin = false>
class DynamicsLanes {
 public:
  using Pass = NewtonEuler<Pack, kSpin>;
  using State = std::conditional_t<kSpin, SpinningStateVector, StateVector>;

  DynamicsLanes(const DynamicsConstants& constants, int first, int count, const State* x)
      : index_{first, std::min(first + 1, count - 1), std::min(first + 2, count - 1),
               std::min(first + 3, count - 1)},
        pass(constants, gathered<0, kPositionDim>(x), gathered<kPositionDim, Pass::kVelocities>(x)),
        nu(gathered<kPositionDim, Pass::kVelocities>(x)) {}

  template <int kFirst, int kSize, typename Vector>
  Eigen::Matrix<Pack, kSize, 1> gathered(const Vector* vectors) const {
    Eigen::Matrix<Pack, kSize, 1> out;
    const double* from[Pack::kLanes];
    for (int l = 0; l < Pack::kLanes; ++l) from[l] = vectors[index_[l]].data() + kFirst;
    gather<kSize>(from, out.data());
    return out;
  }

  /// One number per state.
  Pack gathered(const double* numbers) const {
    return Pack(Pack::Lanes{numbers[index_[0]], numbers[index_[1]], numbers[index_[2]],
                            numbers[index_[3]]});
  }

  /// Writes N values per lane; to(element) gives the address in an element of the output array.
  template <int N, typename Output, typename Address>
  void put(const Pack* values, Output* out, Address&& to) const {
    double* addresses[Pack::kLanes];
    for (int l = 0; l < Pack::kLanes; ++l) addresses[l] = to(out[index_[l]]);
    scatter<N>(values, addresses);
  }

 private:
  int index_[Pack::kLanes];

 public:
  Pass pass;
  typename Pass::Velocities nu;
};

}  // namespace ballbot
