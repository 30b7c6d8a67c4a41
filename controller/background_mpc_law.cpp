#include "controller/background_mpc_law.hpp"

#include <cerrno>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace ballbot {

BackgroundMpcLaw::BackgroundMpcLaw(const RobotParameters& robot, const MpcConfig& config)
    : fallback_after_(config.fallback_after),
      shaping_(config.shaping),
      lqr_(robot, config.lqr),
      planner_(robot, config),
      requests_(Request{}),
      results_(Result{planner_.emptyPolicy(), PlanReport{}}) {
  sem_init(&wake_, 0, 0);
  solver_ = std::thread([this] { solveForever(); });
}

BackgroundMpcLaw::~BackgroundMpcLaw() {
  quit_.store(true);
  sem_post(&wake_);
  solver_.join();
  sem_destroy(&wake_);
}

void BackgroundMpcLaw::solveForever() {
  MpcPolicy previous = planner_.emptyPolicy(), next = previous;
  for (;;) {
    while (sem_wait(&wake_) != 0 && errno == EINTR) {
    }
    if (quit_.load()) return;
    if (!requests_.update()) continue;  // several requests at once: the newest has been taken
    const Request& r = requests_.front();
    Result& result = results_.back();
    planner_.setContactForce(r.contact_force_W);
    result.report = planner_.plan(r.now, r.x, r.xf, r.joint_angle, r.stand_in, previous, next);
    if (result.report.accepted) std::swap(previous, next);
    result.policy = previous;
    results_.publish();
    solves_.fetch_add(1);
  }
}

bool BackgroundMpcLaw::inForce(SimTime now) const noexcept {
  const MpcPolicy& policy = results_.front().policy;
  return policy.valid() && now - policy.stamp() <= fallback_after_;
}

PlanReport BackgroundMpcLaw::plan(SimTime now, const StateVector& x,
                                  const JointVector& joint_angle) noexcept {
  const bool had_plan = results_.front().policy.valid();
  if (x.allFinite() && (inForce(now) || !had_plan)) {
    lqr_.setGroundSetPoint(x.segment<2>(kBallX), x[kYaw]);
  }
  Request& request = requests_.back();
  lqr_.plan(now, x, joint_angle);
  lqr_.samplePlan(now, request.stand_in);
  request.now = now;
  request.x = x;
  request.xf = xf_;
  request.joint_angle = joint_angle;
  request.contact_force_W = contact_force_W_;
  requests_.publish();
  sem_post(&wake_);
  PlanReport report = results_.front().report;
  report.fallback = had_plan && !inForce(now);
  return report;
}

void BackgroundMpcLaw::activatePlan() noexcept {
  results_.update();
  lqr_.activatePlan();
}

void BackgroundMpcLaw::sample(SimTime now, PolicySample& out) const noexcept {
  if (inForce(now)) {
    results_.front().policy.sample(now, xf_, out);
  } else {
    lqr_.sample(now, out);
  }
}

void BackgroundMpcLaw::commanded(SimTime, SimDuration period, const JointVector& torque) noexcept {
  const double a = std::exp(-shaping_.pole * toSeconds(period));
  xf_ = a * xf_ + (1 - a) * torque.head<kWheelCount>();
}

StateBlob BackgroundMpcLaw::saveState() const {
  throw InputError("a controller with mpc.solver_thread: true cannot be saved or restored; set it "
                   "to false for runs that must repeat");
}

void BackgroundMpcLaw::restoreState(const StateBlob&) { saveState(); }

}  // namespace ballbot
