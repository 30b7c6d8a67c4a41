#include "controller/mpc_law.hpp"

#include <utility>

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
  const PolicySample stand_in = execution_.planStandIn(active_, failed_plans_ > 0, now, x, joint_angle);
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

StateBlob MpcLaw::saveState() const {
  BlobWriter out;
  planned_.save(out);
  active_.save(out);
  execution_.saveFilter(out);
  out.put(planner_.shift());
  out.put(failed_plans_);
  planner_.contact().save(out);
  planner_.governor().save(out);
  out.putBlob(execution_.saveStandIn());
  return out.seal(kBlobKind, kBlobVersion);
}

void MpcLaw::restoreState(const StateBlob& blob) {
  BlobReader in(blob, kBlobKind, kBlobVersion);
  MpcPolicy planned = planned_, active = active_;
  planned.restore(in);
  active.restore(in);
  Vector3 xf;
  in.getDoubles(xf.data(), xf.size());
  const double shift = in.get<double>();
  const auto failed_plans = in.get<std::int64_t>();
  ContactSupervisor supervisor = planner_.contact();
  supervisor.restore(in);
  CommandGovernor governor = planner_.governor();
  governor.restore(in);
  const StateBlob stand_in = in.getBlob();
  in.finish();
  execution_.restore(xf, stand_in);
  planned_ = std::move(planned);
  active_ = std::move(active);
  planner_.setShift(shift);
  failed_plans_ = failed_plans;
  planner_.setContact(supervisor);
  planner_.setGovernor(governor);
}

}  // namespace ballbot
