#include "controller/lost_wheel_problem.hpp"

#include <algorithm>

#include "controller/input_sizes.hpp"

namespace ballbot {
namespace {

constexpr int kTogether = 4;  ///< stages: as many as the dynamics take at once

template <typename U>
U withoutLost(const WheelFlags& lost, const U& u) noexcept {
  U out = u;
  for (int i = 0; i < kWheelCount; ++i) {
    if (lost[static_cast<std::size_t>(i)]) out[i] = 0;
  }
  return out;
}

template <typename U>
double lostSquares(const WheelFlags& lost, const U& u) noexcept {
  double sum = 0;
  for (int i = 0; i < kWheelCount; ++i) {
    if (lost[static_cast<std::size_t>(i)]) sum += u[i] * u[i];
  }
  return 0.5 * sum;
}

/// Takes the inputs of lost wheels out of an expansion, and gives them their squares.
/// What another problem wrote into the stage and this one's inner does not write is taken out as
/// well: the wheels' torques by the tilt (FloorLimitedProblem).
template <int NU, typename U>
void disconnect(const WheelFlags& lost, const U& u, LqStage<kMpcStateDim, NU>& lq) noexcept {
  auto B = lq.B();
  auto Pt = lq.Pt();
  Pt.template block<2, kWheelCount>(kPitch, 0).setZero();
  auto R = lq.R();
  auto r = lq.r();
  for (int i = 0; i < kWheelCount; ++i) {
    if (!lost[static_cast<std::size_t>(i)]) continue;
    B.col(i).setZero();
    Pt.col(i).setZero();
    R.col(i).setZero();
    R.row(i).setZero();
    R(i, i) = 1;
    r[i] = u[i];
  }
}

}  // namespace

template <int NU>
void LostWheelProblem<NU>::step(int k, const X& x, const U& u, X& next) const noexcept {
  this->inner().step(k, x, withoutLost(lost_, u), next);
}

template <int NU>
void LostWheelProblem<NU>::addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept {
  this->inner().addCost(k, x, withoutLost(lost_, u), terms);
  terms.value[kWheelTorqueCost] += lostSquares(lost_, u);
}

template <int NU>
void LostWheelProblem<NU>::approximate(int first, int count, const X* x, const U* u,
                                       CostTerms* terms, Stage* lq) const noexcept {
  U left[kTogether];
  for (int i = 0; i < count; i += kTogether) {
    const int now = std::min(kTogether, count - i);
    for (int j = 0; j < now; ++j) left[j] = withoutLost(lost_, u[i + j]);
    this->inner().approximate(first + i, now, x + i, left, terms + i, lq + i);
    for (int j = 0; j < now; ++j) {
      terms[i + j].value[kWheelTorqueCost] += lostSquares(lost_, u[i + j]);
      disconnect<NU>(lost_, u[i + j], lq[i + j]);
    }
  }
}

template <int NU>
void LostWheelContinuousProblem<NU>::flow(const X& x, const U& u, X& dx) const noexcept {
  this->inner().flow(x, withoutLost(lost_, u), dx);
}

template <int NU>
void LostWheelContinuousProblem<NU>::addCostRate(const X& x, const U& u,
                                                 CostTerms& terms) const noexcept {
  this->inner().addCostRate(x, withoutLost(lost_, u), terms);
  terms.value[kWheelTorqueCost] += lostSquares(lost_, u);
}

template <int NU>
void LostWheelContinuousProblem<NU>::expand(const X& x, const U& u, X& dx,
                                            Expansion& out) const noexcept {
  this->inner().expand(x, withoutLost(lost_, u), dx, out);
  disconnect<NU>(lost_, u, out);
}

#define BALLBOT_INSTANTIATE(NU)        \
  template class LostWheelProblem<NU>; \
  template class LostWheelContinuousProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
