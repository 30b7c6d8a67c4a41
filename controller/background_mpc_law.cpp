#include "controller/background_mpc_law.hpp"

#include <cerrno>
#include <utility>

#include "core/error.hpp"

namespace ballbot {

BackgroundMpcLaw::BackgroundMpcLaw(const RobotParameters& robot, const MpcConfig& config)
    : execution_(robot, config),
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
    planner_.setFloorHeld(r.floor_held);
    planner_.setLastingForces(r.lasting);
    result.report = planner_.plan(r.now, r.x, r.xf, r.joint_angle, r.stand_in, previous, next);
    if (result.report.accepted) std::swap(previous, next);
    result.policy = previous;
    results_.publish();
    solves_.fetch_add(1);
  }
}

PlanReport BackgroundMpcLaw::plan(SimTime now, const StateVector& x,
                                  const JointVector& joint_angle) noexcept {
  const MpcPolicy& active = results_.front().policy;
  const bool refused = !results_.front().report.accepted;
  Request& request = requests_.back();
  request.stand_in = execution_.planStandIn(active, refused, now, x, joint_angle);
  request.now = now;
  request.x = x;
  request.xf = execution_.filterState();
  request.joint_angle = joint_angle;
  request.contact_force_W = contact_force_W_;
  request.floor_held = floor_held_;
  request.lasting = lasting_;
  requests_.publish();
  sem_post(&wake_);
  PlanReport report = results_.front().report;
  report.fallback = execution_.fellBack(active, refused, now);
  return report;
}

void BackgroundMpcLaw::activatePlan() noexcept {
  results_.update();
  execution_.activateStandIn();
}

void BackgroundMpcLaw::sample(SimTime now, PolicySample& out) const noexcept {
  execution_.sample(results_.front().policy, now, out);
}

void BackgroundMpcLaw::commanded(SimTime, SimDuration period, const JointVector& torque) noexcept {
  execution_.commanded(period, torque);
}

StateBlob BackgroundMpcLaw::saveState() const {
  throw InputError(
      "a controller with mpc.solver_thread: true cannot be saved or restored; set it "
      "to false for runs that must repeat");
}

void BackgroundMpcLaw::restoreState(const StateBlob&) { saveState(); }

}  // namespace ballbot
