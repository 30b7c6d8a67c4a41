#include "controller/slq_solver.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
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

/// Approximates the cost of stages the rollout has already reached. Every stage is computed by the
/// same call whoever makes it, so the result does not depend on how many threads there are.
template <int NX, int NU>
class SlqSolver<NX, NU>::Helper {
 public:
  explicit Helper(SlqSolver& solver) : solver_(solver), thread_([this] { run(); }) {}
  ~Helper() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      quit_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }

  void start(const Problem& problem) {
    reached_.store(0, std::memory_order_relaxed);
    finished_.store(false, std::memory_order_relaxed);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      problem_ = &problem;
    }
    wake_.notify_one();
  }
  /// x and u of the first `stages` stages are final.
  void publish(int stages) noexcept { reached_.store(stages, std::memory_order_release); }
  void wait() const noexcept {
    while (!finished_.load(std::memory_order_acquire)) std::this_thread::yield();
  }

 private:
  void run() {
    for (;;) {
      const Problem* problem = nullptr;
      {
        std::unique_lock<std::mutex> lock(mutex_);
        wake_.wait(lock, [this] { return quit_ || problem_; });
        if (quit_) return;
        std::swap(problem, problem_);
      }
      const int stages = problem->stages();
      for (int k = 0; k < stages; ++k) {
        while (reached_.load(std::memory_order_acquire) <= k) std::this_thread::yield();
        solver_.approximateCostOf(*problem, k);
      }
      finished_.store(true, std::memory_order_release);
    }
  }

  SlqSolver& solver_;
  std::mutex mutex_;
  std::condition_variable wake_;
  const Problem* problem_ = nullptr;
  bool quit_ = false;
  std::atomic<int> reached_{0};
  std::atomic<bool> finished_{true};
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
void SlqSolver<NX, NU>::approximateCostOf(const Problem& problem, int k) noexcept {
  stage_terms_[k] = CostTerms{};
  problem.approximateCost(k, nominal_.x[k], nominal_.u[k], stage_terms_[k], lq_[k]);
}

template <int NX, int NU>
CostTerms SlqSolver<NX, NU>::approximate(const Problem& problem, const X& x0) noexcept {
  const int stages = problem.stages();
  if (helper_) helper_->start(problem);
  X x = x0;
  for (int k = 0; k < stages; ++k) {
    nominal_.u[k] += nominal_.gain[k].K() * (x - nominal_.x[k]);
    nominal_.x[k] = x;
    if (helper_) helper_->publish(k + 1);
    problem.linearizeStep(k, nominal_.x[k], nominal_.u[k], x, lq_[k]);
    if (!helper_) approximateCostOf(problem, k);
  }
  nominal_.x[stages] = x;
  CostTerms final_terms;
  problem.approximateFinalCost(x, final_terms, final_value_);
  if (helper_) helper_->wait();

  CostTerms terms;
  for (int k = 0; k < stages; ++k) terms += stage_terms_[k];
  terms += final_terms;
  return terms;
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
  const CostTerms nominal_terms = approximate(problem, x0);
  report.nominal_cost = report.cost = nominal_terms.total();
  const std::int64_t t1 = now();
  report.times.approximation_ns = t1 - t0;
  if (!std::isfinite(report.nominal_cost)) {
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

}  // namespace ballbot
