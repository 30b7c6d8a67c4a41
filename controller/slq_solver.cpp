#include "controller/slq_solver.hpp"

#include <semaphore.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <thread>

#include "controller/line_search.hpp"

namespace ballbot {
namespace {

constexpr CostNoise kRounding{1e-11, 1e-13};

}  // namespace

const char* slqStatusName(SlqStatus status) {
  switch (status) {
    case SlqStatus::kImproved: return "improved";
    case SlqStatus::kConverged: return "converged";
    case SlqStatus::kNoDescent: return "no descent";
    case SlqStatus::kNotFinite: return "not finite";
    case SlqStatus::kNotConvex: return "not convex";
  }
  return "";
}

/// A second thread that shares the approximation. Blocks of stages go to whoever is free, so that a
/// helper that does not get a processor holds nobody up for longer than one block. A stage is
/// computed by the same call whoever makes it: the result does not depend on the sharing.
template <int NX, int NU>
class SlqSolver<NX, NU>::Helper {
 public:
  explicit Helper(SlqSolver& solver)
      : solver_(solver), stages_(static_cast<int>(solver.lq_.size())), next_(stages_) {
    sem_init(&wake_, 0, 0);
    thread_ = std::thread([this] { run(); });
  }
  ~Helper() {
    quit_.store(true);
    sem_post(&wake_);
    thread_.join();
    sem_destroy(&wake_);
  }

  /// Wakes the helper ahead of time, so that it is there when the rollout is done.
  void prepare() noexcept {
    rolled_out_.store(false, std::memory_order_relaxed);
    sem_post(&wake_);
  }
  /// After prepare(), when there is nothing to share after all.
  void cancel() noexcept { rolled_out_.store(true, std::memory_order_release); }
  /// After prepare() and the rollout: approximates all stages, together with the helper.
  void approximate(const Problem& problem) noexcept {
    problem_ = &problem;
    finished_.store(0, std::memory_order_relaxed);
    next_.store(0, std::memory_order_release);  // from here on blocks can be taken
    rolled_out_.store(true, std::memory_order_release);
    takeBlocks();
    while (finished_.load(std::memory_order_acquire) < stages_) std::this_thread::yield();
  }

 private:
  static constexpr int kBlock = 4;

  void takeBlocks() noexcept {
    for (;;) {
      const int first = next_.fetch_add(kBlock, std::memory_order_acq_rel);
      if (first >= stages_) return;
      const int count = std::min(kBlock, stages_ - first);
      solver_.approximateStages(*problem_, first, count);
      finished_.fetch_add(count, std::memory_order_release);
    }
  }
  void run() noexcept {
    for (;;) {
      while (sem_wait(&wake_) != 0 && errno == EINTR) {
      }
      if (quit_.load()) return;
      while (!rolled_out_.load(std::memory_order_acquire)) std::this_thread::yield();
      takeBlocks();
    }
  }

  SlqSolver& solver_;
  const int stages_;
  const Problem* problem_ = nullptr;
  sem_t wake_;
  std::atomic<bool> quit_{false}, rolled_out_{false};
  std::atomic<int> next_;         // stage nobody has taken yet
  std::atomic<int> finished_{0};  // stages that are done
  std::thread thread_;
};

template <int NX, int NU>
SlqSolver<NX, NU>::SlqSolver(int stages, const SlqOptions& options)
    : options_(options), shift_(options.base_shift), lq_(stages), stage_terms_(stages) {
  nominal_.resize(stages);
  solution_.resize(stages);
  candidate_.resize(stages);
  if (options.threads > 1) helper_ = std::make_unique<Helper>(*this);
}

template <int NX, int NU>
SlqSolver<NX, NU>::~SlqSolver() = default;

template <int NX, int NU>
bool SlqSolver<NX, NU>::rollOutNominal(const Problem& problem, const X& x0) noexcept {
  X x = x0;
  for (int k = 0; k < problem.stages(); ++k) {
    nominal_.u[k] += nominal_.gain[k].K() * (x - nominal_.x[k]);
    nominal_.x[k] = x;
    problem.step(k, nominal_.x[k], nominal_.u[k], x);
  }
  nominal_.x[problem.stages()] = x;
  return x.allFinite();
}

template <int NX, int NU>
void SlqSolver<NX, NU>::approximateStages(const Problem& problem, int first, int count) noexcept {
  std::fill_n(stage_terms_.begin() + first, count, CostTerms{});
  problem.approximate(first, count, &nominal_.x[first], &nominal_.u[first], &stage_terms_[first],
                      &lq_[first]);
}

template <int NX, int NU>
bool SlqSolver<NX, NU>::approximate(const Problem& problem, const X& x0,
                                    CostTerms& terms) noexcept {
  if (helper_) helper_->prepare();
  if (!rollOutNominal(problem, x0)) {
    if (helper_) helper_->cancel();
    return false;
  }
  if (helper_) {
    helper_->approximate(problem);
  } else {
    approximateStages(problem, 0, problem.stages());
  }
  CostTerms final_terms;
  problem.approximateFinalCost(nominal_.x.back(), final_terms, final_value_);
  for (const CostTerms& stage : stage_terms_) terms += stage;
  terms += final_terms;
  return std::isfinite(terms.total());
}

template <int NX, int NU>
bool SlqSolver<NX, NU>::sweep(double& predicted_decrease) noexcept {
  ValueFunction<NX> value = final_value_;
  for (int k = static_cast<int>(lq_.size()) - 1; k >= 0; --k) {
    if (!riccatiStep(lq_[k], shift_, value, candidate_.gain[k])) return false;
  }
  predicted_decrease = -value.constant();
  return std::isfinite(predicted_decrease);
}

template <int NX, int NU>
CostTerms SlqSolver<NX, NU>::tryStep(const Problem& problem, double alpha) noexcept {
  CostTerms terms;
  const int stages = problem.stages();
  candidate_.x[0] = nominal_.x[0];
  for (int k = 0; k < stages; ++k) {
    const StageGain<NX, NU>& gain = candidate_.gain[k];
    const X dx = candidate_.x[k] - nominal_.x[k];
    candidate_.u[k] = nominal_.u[k] + alpha * gain.k();
    candidate_.u[k].noalias() += gain.K() * dx;
    CostTerms stage;
    problem.addCost(k, candidate_.x[k], candidate_.u[k], stage);
    terms += stage;
    problem.step(k, candidate_.x[k], candidate_.u[k], candidate_.x[k + 1]);
  }
  CostTerms final_terms;
  problem.addFinalCost(candidate_.x[stages], final_terms);
  terms += final_terms;
  return terms;
}

template <int NX, int NU>
SlqReport SlqSolver<NX, NU>::iterate(const Problem& problem, const X& x0) noexcept {
  SlqReport report;
  const auto now = [this] { return options_.clock ? options_.clock() : 0; };
  const auto raiseShift = [this] {
    shift_ = std::min(options_.largest_shift, 10 * shift_);
  };

  const std::int64_t t0 = now();
  CostTerms nominal_terms;
  const bool finite = approximate(problem, x0, nominal_terms);
  const std::int64_t t1 = now();
  report.times.approximation_ns = t1 - t0;
  report.nominal_cost = report.cost = nominal_terms.total();
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
      nominal_terms, options_, kRounding,
      [&](double alpha) { return tryStep(problem, alpha); }, report);
  report.times.line_search_ns = now() - t2;
  if (!accepted) {
    raiseShift();
    return report;
  }
  shift_ = std::max(options_.base_shift, shift_ / 10);
  std::swap(solution_, candidate_);
  return report;
}

template <int NX, int NU>
SlqReport SlqSolver<NX, NU>::converge(const Problem& problem, const X& x0, int limit,
                                      double tolerance, std::vector<double>* costs) {
  SlqReport last, accepted;
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

template class SlqSolver<4, 2>;
template class SlqSolver<19, 6>;
template class SlqSolver<19, 9>;
template class SlqSolver<19, 12>;

}  // namespace ballbot
