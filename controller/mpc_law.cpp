#include "controller/mpc_law.hpp"

#include <cmath>
#include <utility>

namespace ballbot {
namespace {

constexpr char kBlobKind[] = "mpc_law";
constexpr std::uint32_t kBlobVersion = 2;

}  // namespace

MpcLaw::MpcLaw(const RobotParameters& robot, const MpcConfig& config)
    : fallback_after_(config.fallback_after),
      shaping_(config.shaping),
      lqr_(robot, config.lqr),
      planner_(robot, config),
      planned_(planner_.emptyPolicy()),
      active_(planned_),
      scratch_(planned_) {}

bool MpcLaw::inForce(SimTime now) const noexcept {
  return active_.valid() && now - active_.stamp() <= fallback_after_;
}

PlanReport MpcLaw::plan(SimTime now, const StateVector& x,
                        const JointVector& joint_angle) noexcept {
  // As long as plans are good the stand-in's set-point follows the robot, so that it holds the
  // place where it had to take over.
  if (x.allFinite() && (inForce(now) || !active_.valid())) {
    lqr_.setGroundSetPoint(x.segment<2>(kBallX), x[kYaw]);
  }
  PolicySample stand_in;
  lqr_.plan(now, x, joint_angle);
  lqr_.samplePlan(now, stand_in);
  PlanReport report = planner_.plan(now, x, xf_, joint_angle, stand_in, planned_, scratch_);
  if (report.accepted) {
    std::swap(planned_, scratch_);
  } else {
    ++failed_plans_;
  }
  report.fallback = !inForce(now) && active_.valid();
  return report;
}

void MpcLaw::activatePlan() noexcept {
  active_ = planned_;
  lqr_.activatePlan();
}

void MpcLaw::sample(SimTime now, PolicySample& out) const noexcept {
  if (inForce(now)) {
    active_.sample(now, xf_, out);
  } else {
    lqr_.sample(now, out);
  }
}

void MpcLaw::commanded(SimTime, SimDuration period, const JointVector& torque) noexcept {
  const double a = std::exp(-shaping_.pole * toSeconds(period));
  xf_ = a * xf_ + (1 - a) * torque.head<kWheelCount>();
}

StateBlob MpcLaw::saveState() const {
  BlobWriter out;
  planned_.save(out);
  active_.save(out);
  out.putDoubles(xf_.data(), xf_.size());
  out.put(planner_.shift());
  out.put(failed_plans_);
  planner_.contact().save(out);
  out.putBlob(lqr_.saveState());
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
  const StateBlob lqr = in.getBlob();
  in.finish();
  lqr_.restoreState(lqr);
  planned_ = std::move(planned);
  active_ = std::move(active);
  xf_ = xf;
  planner_.setShift(shift);
  failed_plans_ = failed_plans;
  planner_.setContact(supervisor);
}

}  // namespace ballbot
