#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "solver/continuous_slq.hpp"
#include "solver/line_search.hpp"
#include "solver/riccati_impl.hpp"

namespace ballbot {
namespace detail {

/// to = a + share (b - a), element by element.
template <typename Array>
void interpolate(const Array& a, const Array& b, double share, Array& to) {
  for (std::size_t i = 0; i < std::size(a); ++i) to[i] = a[i] + share * (b[i] - a[i]);
}

}  // namespace detail

template <int NX, int NU, typename Cost>
struct ContinuousSlq<NX, NU, Cost>::RolloutFlow {
  static void evaluate(double t, const double* y, double* dy, void* self) {
    ContinuousSlq& e = *static_cast<ContinuousSlq*>(self);
    const Eigen::Map<const X> x(y);
    e.problem_->setTime(t);
    const U u = e.inputAt(t, x, e.alpha_);
    X dx;
    e.problem_->flow(x, u, dx);
    std::copy_n(dx.data(), NX, dy);
    Cost rate;
    e.problem_->addCostRate(x, u, rate);
    std::copy_n(std::begin(rate.value), Cost::kCount, dy + NX);
  }
};

template <int NX, int NU, typename Cost>
struct ContinuousSlq<NX, NU, Cost>::RiccatiFlow {
  /// In time to go, s = T - t, so that the integration runs forward.
  static void evaluate(double to_go, const double* y, double* dy, void* self) {
    ContinuousSlq& e = *static_cast<ContinuousSlq*>(self);
    const double t = e.knots_.back() - to_go;
    const int k = e.interval_;
    const double share = (t - e.knots_[k]) / (e.knots_[k + 1] - e.knots_[k]);
    const auto &before = e.expansions_[k], &after = e.expansions_[k + 1];
    auto& lq = e.between_;
    detail::interpolate(before.Ft, after.Ft, share, lq.Ft);
    detail::interpolate(before.Wxx, after.Wxx, share, lq.Wxx);
    detail::interpolate(before.Wxu, after.Wxu, share, lq.Wxu);
    detail::interpolate(before.Wuu, after.Wuu, share, lq.Wuu);

    if (!riccatiRate(lq, e.shift_, y, dy)) std::fill_n(dy, kRiccatiDim, std::nan(""));
  }
};

template <int NX, int NU, typename Cost>
ContinuousSlq<NX, NU, Cost>::ContinuousSlq(const std::vector<double>& knots,
                                           const SlqOptions& options,
                                           const ContinuousOptions& continuous, const X& state_size)
    : knots_(knots),
      options_(options),
      tolerance_(continuous.tolerance),
      shift_(options.base_shift),
      nodes_(knots.size()),
      rolled_x_(knots.size()),
      rolled_u_(knots.size()),
      expansions_(knots.size()) {
  constexpr double kRolloutInitialStep = 2e-3, kRiccatiInitialStep = 5e-4;  // [s]
  for (auto& e : expansions_) e.forRates();
  between_.forRates();
  const int n = static_cast<int>(knots.size());
  solution_.reset(n, n);
  const double rtol = continuous.tolerance;
  std::vector<double> tolerance(kRolloutDim, rtol);
  for (int i = 0; i < NX; ++i) tolerance[i] = state_size[i] * rtol;
  rollout_ = std::make_unique<ErkIntegrator>(kRolloutDim, &RolloutFlow::evaluate, this, rtol,
                                             tolerance.data(), kRolloutInitialStep);
  tolerance.assign(kRiccatiDim, 10 * rtol);
  riccati_ = std::make_unique<ErkIntegrator>(kRiccatiDim, &RiccatiFlow::evaluate, this, 10 * rtol,
                                             tolerance.data(), kRiccatiInitialStep);
}

template <int NX, int NU, typename Cost>
typename ContinuousSlq<NX, NU, Cost>::X ContinuousSlq<NX, NU, Cost>::nominalAt(
    double t) const noexcept {
  const Node &a = nodes_[interval_], &b = nodes_[interval_ + 1];
  const double h = knots_[interval_ + 1] - knots_[interval_];
  const double s = (t - knots_[interval_]) / h;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a.x + (3 * s2 - 2 * s3) * b.x + h * (s3 - 2 * s2 + s) * a.dx +
         h * (s3 - s2) * b.dx;
}

template <int NX, int NU, typename Cost>
typename ContinuousSlq<NX, NU, Cost>::U ContinuousSlq<NX, NU, Cost>::inputAt(
    double t, const X& x, double alpha) const noexcept {
  const Node &a = nodes_[interval_], &b = nodes_[interval_ + 1];
  const double s = (t - knots_[interval_]) / (knots_[interval_ + 1] - knots_[interval_]);
  const X dx = x - nominalAt(t);
  U u = (1 - s) * (a.u + alpha * a.step) + s * (b.u + alpha * b.step);
  u.noalias() += (1 - s) * (a.K * dx) + s * (b.K * dx);
  return u;
}

template <int NX, int NU, typename Cost>
bool ContinuousSlq<NX, NU, Cost>::rollout(const X& x0, double alpha, Cost& cost) noexcept {
  alpha_ = alpha;
  double y[kRolloutDim] = {};
  std::copy_n(x0.data(), NX, y);
  if (!rollout_->start(knots_[0], y)) return false;
  rolled_x_[0] = x0;
  interval_ = 0;
  rolled_u_[0] = inputAt(knots_[0], x0, alpha);
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
    interval_ = static_cast<int>(k);
    if (!rollout_->advanceTo(knots_[k + 1])) return false;
    rolled_x_[k + 1] = Eigen::Map<const X>(rollout_->y());
    if (!rolled_x_[k + 1].allFinite()) return false;
    rolled_u_[k + 1] = inputAt(knots_[k + 1], rolled_x_[k + 1], alpha);
  }
  cost = Cost{};
  std::copy_n(rollout_->y() + NX, Cost::kCount, std::begin(cost.value));
  problem_->setTime(knots_.back());
  problem_->addFinalCost(rolled_x_.back(), cost);
  // Violations are looked for where the policy has its knots.
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    Cost rate;
    problem_->setTime(knots_[k]);
    problem_->addCostRate(rolled_x_[k], rolled_u_[k], rate);
    cost.violation = std::max(cost.violation, rate.violation);
  }
  return std::isfinite(cost.total());
}

template <int NX, int NU, typename Cost>
void ContinuousSlq<NX, NU, Cost>::adoptRollout() noexcept {
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    nodes_[k].x = rolled_x_[k];
    nodes_[k].u = rolled_u_[k];
    nodes_[k].step.setZero();
    problem_->setTime(knots_[k]);
    problem_->flow(nodes_[k].x, nodes_[k].u, nodes_[k].dx);
  }
}

template <int NX, int NU, typename Cost>
void ContinuousSlq<NX, NU, Cost>::expand() noexcept {
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    problem_->setTime(knots_[k]);
    problem_->expand(nodes_[k].x, nodes_[k].u, nodes_[k].dx, expansions_[k]);
  }
  problem_->expandFinalCost(nodes_.back().x, final_value_);
}

template <int NX, int NU, typename Cost>
bool ContinuousSlq<NX, NU, Cost>::sweep(double& predicted_decrease) noexcept {
  const int last = static_cast<int>(knots_.size()) - 1;
  const auto setPolicy = [this](int k, const double* value) {
    StageGain<NX, NU> gain;
    if (!riccatiRateGain(expansions_[k], shift_, value, gain)) return false;
    nodes_[k].K = gain.K();
    nodes_[k].step = gain.k();
    return nodes_[k].K.allFinite();
  };
  if (!setPolicy(last, final_value_.S_aug) || !riccati_->start(0, final_value_.S_aug)) return false;
  for (int k = last - 1; k >= 0; --k) {
    interval_ = k;
    if (!riccati_->advanceTo(knots_[last] - knots_[k]) || !setPolicy(k, riccati_->y())) {
      return false;
    }
  }
  predicted_decrease = -0.5 * riccati_->y()[NX * Value::kX + NX];
  return std::isfinite(predicted_decrease);
}

template <int NX, int NU, typename Cost>
SlqReport<Cost> ContinuousSlq<NX, NU, Cost>::iterate(const X& x0) noexcept {
  // Relative error of the predicted decrease: between knots the expansion is interpolated.
  constexpr double kModelError = 1e-3;
  Report report;
  const auto now = [this] { return options_.clock ? options_.clock() : 0; };
  const std::int64_t begun = now();
  Cost nominal;
  if (!rollout(x0, 0, nominal)) {
    report.status = SlqStatus::kNotFinite;
    return report;
  }
  report.nominal_cost = report.cost = nominal.total();
  adoptRollout();
  expand();
  const std::int64_t expanded = now();
  report.times.approximation_ns = expanded - begun;
  while (!sweep(report.predicted_decrease)) {
    if (shift_ >= options_.largest_shift) {
      report.status = SlqStatus::kNotConvex;
      return report;
    }
    shift_ = std::min(options_.largest_shift, 10 * shift_);
  }
  report.shift = shift_;
  const std::int64_t swept = now();
  report.times.riccati_ns = swept - expanded;

  const bool accepted = searchAlongLine(
      nominal, options_, CostNoise{tolerance_, kModelError},
      [&](double alpha) {
        Cost cost;
        if (!rollout(x0, alpha, cost)) cost.value[0] = std::nan("");
        return cost;
      },
      report);
  report.times.line_search_ns = now() - swept;
  if (!accepted) {
    shift_ = std::min(options_.largest_shift, 10 * shift_);
    return report;
  }
  shift_ = std::max(options_.base_shift, shift_ / 10);
  adoptRollout();
  return report;
}

template <int NX, int NU, typename Cost>
SlqReport<Cost> ContinuousSlq<NX, NU, Cost>::iterate(const X& x0, int limit) noexcept {
  Report last, accepted;
  bool any = false;
  for (int i = 0; i < limit; ++i) {
    last = iterate(x0);
    last.iterations = i + 1;
    if (last.ok()) {
      any = true;
      accepted = last;
      for (std::size_t k = 0; k < knots_.size(); ++k) {
        solution_.x[k] = nodes_[k].x;
        solution_.u[k] = nodes_[k].u;
        solution_.gain[k].K() = nodes_[k].K;
      }
      if (last.status == SlqStatus::kConverged) break;
    } else if (last.status != SlqStatus::kNoDescent || shift_ >= options_.largest_shift) {
      break;
    }
  }
  return any ? accepted : last;
}

}  // namespace ballbot
