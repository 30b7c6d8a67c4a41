#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "solver/line_search.hpp"
#include "solver/riccati_impl.hpp"
#include "solver/slq_solver.hpp"

namespace ballbot {

template <int NX, int NU, typename Cost>
SlqSolver<NX, NU, Cost>::SlqSolver(int stages, const SlqOptions& options)
    : options_(options), shift_(options.base_shift), lq_(stages), stage_costs_(stages) {
  for (Trajectory* t : {&nominal_, &solution_, &candidate_}) t->reset(stages + 1, stages);
  if (options.threads > 1) {
    const auto work = [](void* self, int first, int count) noexcept {
      SlqSolver& solver = *static_cast<SlqSolver*>(self);
      solver.approximateStages(*solver.shared_problem_, first, count);
    };
    helper_ = std::make_unique<StageHelper>(stages, work, this);
  }
}

template <int NX, int NU, typename Cost>
bool SlqSolver<NX, NU, Cost>::rollOutNominal(const Problem& problem, const X& x0) noexcept {
  X x = x0;
  for (int k = 0; k < problem.stages(); ++k) {
    nominal_.u[k] += nominal_.gain[k].K() * (x - nominal_.x[k]);
    nominal_.x[k] = x;
    problem.step(k, nominal_.x[k], nominal_.u[k], x);
  }
  nominal_.x[problem.stages()] = x;
  return x.allFinite();
}

template <int NX, int NU, typename Cost>
void SlqSolver<NX, NU, Cost>::approximateStages(const Problem& problem, int first,
                                                int count) noexcept {
  std::fill_n(stage_costs_.begin() + first, count, Cost{});
  problem.approximate(first, count, &nominal_.x[first], &nominal_.u[first], &stage_costs_[first],
                      &lq_[first]);
}

template <int NX, int NU, typename Cost>
bool SlqSolver<NX, NU, Cost>::approximate(const Problem& problem, const X& x0,
                                          Cost& cost) noexcept {
  shared_problem_ = &problem;
  if (helper_) helper_->prepare();
  if (!rollOutNominal(problem, x0)) {
    if (helper_) helper_->cancel();
    return false;
  }
  if (helper_) {
    helper_->share();
  } else {
    approximateStages(problem, 0, problem.stages());
  }
  Cost final_cost;
  problem.approximateFinalCost(nominal_.x.back(), final_cost, final_value_);
  for (const Cost& stage : stage_costs_) cost += stage;
  cost += final_cost;
  return std::isfinite(cost.total());
}

template <int NX, int NU, typename Cost>
bool SlqSolver<NX, NU, Cost>::sweep(double& predicted_decrease) noexcept {
  ValueFunction<NX> value = final_value_;
  for (int k = static_cast<int>(lq_.size()) - 1; k >= 0; --k) {
    if (!riccatiStep(lq_[k], shift_, value, candidate_.gain[k])) return false;
  }
  predicted_decrease = -value.constant();
  return std::isfinite(predicted_decrease);
}

template <int NX, int NU, typename Cost>
Cost SlqSolver<NX, NU, Cost>::tryStep(const Problem& problem, double alpha) noexcept {
  Cost cost;
  const int stages = problem.stages();
  candidate_.x[0] = nominal_.x[0];
  for (int k = 0; k < stages; ++k) {
    const StageGain<NX, NU>& gain = candidate_.gain[k];
    const X dx = candidate_.x[k] - nominal_.x[k];
    candidate_.u[k] = nominal_.u[k] + alpha * gain.k();
    candidate_.u[k].noalias() += gain.K() * dx;
    Cost stage;
    problem.addCost(k, candidate_.x[k], candidate_.u[k], stage);
    cost += stage;
    problem.step(k, candidate_.x[k], candidate_.u[k], candidate_.x[k + 1]);
  }
  Cost final_cost;
  problem.addFinalCost(candidate_.x[stages], final_cost);
  cost += final_cost;
  return cost;
}

template <int NX, int NU, typename Cost>
SlqReport<Cost> SlqSolver<NX, NU, Cost>::iterate(const Problem& problem, const X& x0) noexcept {
  constexpr CostNoise kRounding{1e-11, 1e-13};
  Report report;
  const auto now = [this] { return options_.clock ? options_.clock() : 0; };
  const auto raiseShift = [this] { shift_ = std::min(options_.largest_shift, 10 * shift_); };

  const std::int64_t t0 = now();
  Cost nominal;
  const bool finite = approximate(problem, x0, nominal);
  const std::int64_t t1 = now();
  report.times.approximation_ns = t1 - t0;
  report.nominal_cost = report.cost = nominal.total();
  if (!finite) {
    report.status = SlqStatus::kNotFinite;
    return report;
  }

  while (!sweep(report.predicted_decrease)) {
    if (shift_ >= options_.largest_shift) {
      report.status = SlqStatus::kNotConvex;
      return report;
    }
    raiseShift();
  }
  report.shift = shift_;
  const std::int64_t t2 = now();
  report.times.riccati_ns = t2 - t1;

  const bool accepted = searchAlongLine(
      nominal, options_, kRounding, [&](double alpha) { return tryStep(problem, alpha); }, report);
  report.times.line_search_ns = now() - t2;
  if (!accepted) {
    raiseShift();
    return report;
  }
  shift_ = std::max(options_.base_shift, shift_ / 10);
  std::swap(solution_, candidate_);
  return report;
}

template <int NX, int NU, typename Cost>
SlqReport<Cost> SlqSolver<NX, NU, Cost>::converge(const Problem& problem, const X& x0, int limit,
                                                  double tolerance, std::vector<double>* costs) {
  Report last, accepted;
  bool any = false;
  for (int i = 0; i < limit; ++i) {
    last = iterate(problem, x0);
    last.iterations = i + 1;
    if (last.ok()) {
      any = true;
      accepted = last;
      if (costs) costs->push_back(last.cost);
      nominal_ = solution_;
      if (last.predicted_decrease <= tolerance * magnitude(last.terms)) {
        accepted.status = SlqStatus::kConverged;
        break;
      }
    } else if (last.status != SlqStatus::kNoDescent || shift_ >= options_.largest_shift) {
      break;  // after a failed line search alone, a larger shift may still help
    }
  }
  return any ? accepted : last;
}

}  // namespace ballbot
