#include "controller/mpc_law.hpp"

#include <utility>

#include "core/state_visitors.hpp"

namespace ballbot {
namespace {

constexpr char kBlobKind[] = "mpc_law";
constexpr std::uint32_t kBlobVersion = 4;

}  // namespace

MpcLaw::MpcLaw(const RobotParameters& robot, const MpcConfig& config)
    : execution_(robot, config),
      planner_(robot, config),
      planned_(planner_.emptyPolicy()),
      active_(planned_),
      scratch_(planned_) {}

PlanReport MpcLaw::plan(SimTime now, const StateVector& x,
                        const JointVector& joint_angle) noexcept {
  const PolicySample stand_in =
      execution_.planStandIn(active_, failed_plans_ > 0, now, x, joint_angle);
  PlanReport report =
      planner_.plan(now, x, execution_.filterState(), joint_angle, stand_in, planned_, scratch_);
  if (report.accepted) {
    std::swap(planned_, scratch_);
  } else {
    ++failed_plans_;
  }
  report.fallback = execution_.fellBack(active_, failed_plans_ > 0, now);
  return report;
}

void MpcLaw::activatePlan() noexcept {
  active_ = planned_;
  execution_.activateStandIn();
}

void MpcLaw::sample(SimTime now, PolicySample& out) const noexcept {
  execution_.sample(active_, now, out);
}

void MpcLaw::commanded(SimTime, SimDuration period, const JointVector& torque) noexcept {
  execution_.commanded(period, torque);
}

struct MpcLaw::State {
  MpcPolicy planned, active;
  Vector3 filter_state;
  double shift;
  std::int64_t failed_plans;
  ContactSupervisor contact;
  CommandGovernor governor;
  StateBlob stand_in;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.planned);
    visit(self.active);
    visit(self.filter_state);
    visit(self.shift);
    visit(self.failed_plans);
    visit(self.contact);
    visit(self.governor);
    visit(self.stand_in);
  }
};

MpcLaw::State MpcLaw::state() const {
  return {planned_,
          active_,
          execution_.filterState(),
          planner_.shift(),
          failed_plans_,
          planner_.contact(),
          planner_.governor(),
          execution_.saveStandIn()};
}

StateBlob MpcLaw::saveState() const { return saveStateOf(state(), kBlobKind, kBlobVersion); }

void MpcLaw::restoreState(const StateBlob& blob) {
  State next = state();
  restoreStateOf(next, blob, kBlobKind, kBlobVersion);
  execution_.restore(next.filter_state, next.stand_in);
  planned_ = std::move(next.planned);
  active_ = std::move(next.active);
  planner_.setShift(next.shift);
  failed_plans_ = next.failed_plans;
  planner_.setContact(next.contact);
  planner_.setGovernor(next.governor);
}

}  // namespace ballbot
