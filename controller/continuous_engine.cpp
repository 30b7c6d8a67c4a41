#include "controller/continuous_engine.hpp"

#include <algorithm>
#include <cmath>

#include "controller/line_search.hpp"

namespace ballbot {
namespace {

constexpr int kNX = kMpcStateDim;
constexpr int kRolloutDim = kNX + kCostTermCount;  ///< state, and the integral of each cost term
using Value = ValueFunction<kNX>;
constexpr int kRiccatiDim = Value::kX * Value::kX;  ///< augmented value [S s; s^T 2c]
/// Relative error of the predicted decrease: between knots the expansion is interpolated.
constexpr double kModelError = 1e-3;
constexpr double kRolloutInitialStep = 2e-3;       ///< [s]
constexpr double kRiccatiInitialStep = 5e-4;       ///< [s]

/// to = a + share (b - a), element by element.
template <typename Array>
void interpolate(const Array& a, const Array& b, double share, Array& to) {
  for (std::size_t i = 0; i < std::size(a); ++i) to[i] = a[i] + share * (b[i] - a[i]);
}

}  // namespace

template <int NU>
struct ContinuousEngine<NU>::RolloutFlow {
  static void evaluate(double t, const double* y, double* dy, void* self) {
    ContinuousEngine& e = *static_cast<ContinuousEngine*>(self);
    const Eigen::Map<const X> x(y);
    e.tasksAt(t);
    const U u = e.inputAt(t, x, e.alpha_);
    X dx;
    e.problem_.flow(x, u, e.tasks_, dx);
    std::copy_n(dx.data(), kNX, dy);
    CostTerms rate;
    e.problem_.addCostRate(x, u, e.tasks_, rate);
    std::copy(rate.value.begin(), rate.value.end(), dy + kNX);
  }
};

template <int NU>
struct ContinuousEngine<NU>::RiccatiFlow {
  /// In time to go, s = T - t, so that the integration runs forward.
  static void evaluate(double to_go, const double* y, double* dy, void* self) {
    ContinuousEngine& e = *static_cast<ContinuousEngine*>(self);
    const double t = e.knots_.back() - to_go;
    const int k = e.interval_;
    const double share = (t - e.knots_[k]) / (e.knots_[k + 1] - e.knots_[k]);
    const auto &before = e.expansions_[k], &after = e.expansions_[k + 1];
    auto& lq = e.between_;
    interpolate(before.Ft, after.Ft, share, lq.Ft);
    interpolate(before.Wxx, after.Wxx, share, lq.Wxx);
    interpolate(before.Wxu, after.Wxu, share, lq.Wxu);
    interpolate(before.Wuu, after.Wuu, share, lq.Wuu);

    if (!riccatiRate(lq, e.shift_, y, dy)) std::fill_n(dy, kRiccatiDim, std::nan(""));
  }
};

template <int NU>
ContinuousEngine<NU>::ContinuousEngine(const RobotParameters& robot, const Constraints& constraints,
                                       const FrequencyShaping& shaping,
                                       const TerminalCost& terminal,
                                       const std::vector<double>& knots,
                                       std::shared_ptr<const TaskSchedule> schedule,
                                       const SlqOptions& options,
                                       const ContinuousOptions& continuous)
    : knots_(knots),
      schedule_(std::move(schedule)),
      problem_(robot, constraints, shaping, terminal),
      options_(options),
      tolerance_(continuous.tolerance),
      shift_(options.base_shift),
      nodes_(knots.size()),
      rolled_x_(knots.size()),
      rolled_u_(knots.size()),
      expansions_(knots.size()) {
  for (auto& e : expansions_) e.forRates();
  between_.forRates();
  const double rtol = continuous.tolerance;
  std::vector<double> tolerance(kRolloutDim, rtol);
  for (int i = 0; i < kNX; ++i) tolerance[i] = i < kPositionDim ? 0.1 * rtol : rtol;
  rollout_ = std::make_unique<ErkIntegrator>(kRolloutDim, &RolloutFlow::evaluate, this, rtol,
                                             tolerance.data(), kRolloutInitialStep);
  tolerance.assign(kRiccatiDim, 10 * rtol);
  riccati_ = std::make_unique<ErkIntegrator>(kRiccatiDim, &RiccatiFlow::evaluate, this, 10 * rtol,
                                             tolerance.data(), kRiccatiInitialStep);
}

template <int NU>
MpcPolicy ContinuousEngine<NU>::emptyPolicy() const {
  const int n = static_cast<int>(knots_.size());
  MpcPolicy out(n, n);
  for (int k = 0; k < n; ++k) {
    out.knots()[k].time = out.controls()[k].time = knots_[k];
    out.controls()[k].u.setZero();
    out.controls()[k].K.setZero();
  }
  return out;
}

template <int NU>
void ContinuousEngine<NU>::tasksAt(double t) noexcept {
  schedule_->at(t0_ + t, t0_, tasks_, contact_, commands_);
}

template <int NU>
typename ContinuousEngine<NU>::X ContinuousEngine<NU>::nominalAt(double t) const noexcept {
  const Node &a = nodes_[interval_], &b = nodes_[interval_ + 1];
  const double h = knots_[interval_ + 1] - knots_[interval_];
  const double s = (t - knots_[interval_]) / h;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a.x + (3 * s2 - 2 * s3) * b.x + h * (s3 - 2 * s2 + s) * a.dx +
         h * (s3 - s2) * b.dx;
}

template <int NU>
typename ContinuousEngine<NU>::U ContinuousEngine<NU>::inputAt(double t, const X& x,
                                                               double alpha) const noexcept {
  const Node &a = nodes_[interval_], &b = nodes_[interval_ + 1];
  const double s = (t - knots_[interval_]) / (knots_[interval_ + 1] - knots_[interval_]);
  const X dx = x - nominalAt(t);
  U u = (1 - s) * (a.u + alpha * a.step) + s * (b.u + alpha * b.step);
  u.noalias() += (1 - s) * (a.K * dx) + s * (b.K * dx);
  return u;
}

template <int NU>
bool ContinuousEngine<NU>::rollout(const X& x0, double alpha, CostTerms& terms) noexcept {
  alpha_ = alpha;
  double y[kRolloutDim] = {};
  std::copy_n(x0.data(), kNX, y);
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
  terms = CostTerms{};
  std::copy_n(rollout_->y() + kNX, static_cast<int>(kCostTermCount), terms.value.begin());
  tasksAt(knots_.back());
  problem_.addFinalCost(rolled_x_.back(), tasks_, terms);
  // Violations are looked for where the policy has its knots.
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    CostTerms rate;
    tasksAt(knots_[k]);
    problem_.addCostRate(rolled_x_[k], rolled_u_[k], tasks_, rate);
    terms.violation = std::max(terms.violation, rate.violation);
  }
  return std::isfinite(terms.total());
}

template <int NU>
void ContinuousEngine<NU>::adoptRollout() noexcept {
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    nodes_[k].x = rolled_x_[k];
    nodes_[k].u = rolled_u_[k];
    nodes_[k].step.setZero();
    tasksAt(knots_[k]);
    problem_.flow(nodes_[k].x, nodes_[k].u, tasks_, nodes_[k].dx);
  }
}

template <int NU>
void ContinuousEngine<NU>::expand() noexcept {
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    tasksAt(knots_[k]);
    problem_.expand(nodes_[k].x, nodes_[k].u, tasks_, nodes_[k].dx, expansions_[k]);
  }
  problem_.expandFinalCost(nodes_.back().x, tasks_, final_value_);
}

template <int NU>
bool ContinuousEngine<NU>::sweep(double& predicted_decrease) noexcept {
  const int last = static_cast<int>(knots_.size()) - 1;
  const auto setPolicy = [this](int k, const double* value) {
    StageGain<kNX, NU> gain;
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
  predicted_decrease = -0.5 * riccati_->y()[kNX * Value::kX + kNX];
  return std::isfinite(predicted_decrease);
}

template <int NU>
SlqReport ContinuousEngine<NU>::iterate(const X& x0) noexcept {
  SlqReport report;
  const auto now = [this] { return options_.clock ? options_.clock() : 0; };
  const std::int64_t begun = now();
  CostTerms nominal;
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
        CostTerms terms;
        if (!rollout(x0, alpha, terms)) terms.value[0] = std::nan("");
        return terms;
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

template <int NU>
SlqReport ContinuousEngine<NU>::solve(SimTime now, const MpcState& x0, const MpcPolicy& guess,
                                      int iterations, MpcPolicy& out) noexcept {
  t0_ = toSeconds(now);
  const double age = toSeconds(now - guess.stamp());
  MpcInput u;
  MpcGain K;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    Node& node = nodes_[k];
    guess.controlAt(age + knots_[k], u, K);
    node.x = guess.stateAt(age + knots_[k]);
    node.u = u.template head<NU>();
    node.K = K.template topRows<NU>();
    node.step.setZero();
    tasksAt(knots_[k]);
    problem_.flow(node.x, node.u, tasks_, node.dx);
  }

  SlqReport last, accepted;
  bool any = false;
  for (int i = 0; i < iterations; ++i) {
    last = iterate(x0);
    last.iterations = i + 1;
    if (last.ok()) {
      any = true;
      accepted = last;
      for (std::size_t k = 0; k < knots_.size(); ++k) {
        out.knots()[k].x = nodes_[k].x;
        out.controls()[k].u.template head<NU>() = nodes_[k].u;
        out.controls()[k].K.template topRows<NU>() = nodes_[k].K;
      }
      out.setValid(now);
      if (last.status == SlqStatus::kConverged) break;
    } else if (last.status != SlqStatus::kNoDescent || shift_ >= options_.largest_shift) {
      break;
    }
  }
  return any ? accepted : last;
}

template class ContinuousEngine<6>;
template class ContinuousEngine<9>;
template class ContinuousEngine<12>;

}  // namespace ballbot
