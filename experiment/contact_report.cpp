#include "experiment/contact_report.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/angle.hpp"
#include "metrics/static_balance.hpp"

namespace ballbot {
namespace {

constexpr double kBridged_s = 0.1;
constexpr double kSmallest_N = 0.05;
constexpr double kWallThickness = 0.06;  // as drawn [m]

/// The frame that was the newest at each of ascending times.
template <typename Frame>
class Newest {
 public:
  explicit Newest(const std::vector<Frame>& frames) : frames_(frames) {}
  const Frame* at(SimTime time) {
    while (next_ < frames_.size() && frames_[next_].time <= time) ++next_;
    return next_ > 0 ? &frames_[next_ - 1] : nullptr;
  }

 private:
  const std::vector<Frame>& frames_;
  std::size_t next_ = 0;
};

ReplayPose poseOf(const Vector3& p_W, const Matrix3& R) {
  const Eigen::Quaterniond q(R);
  return {{p_W.x(), p_W.y(), p_W.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

/// Middle of a slab of that thickness behind a face.
ReplayPose slabBehind(const Face& face, double thickness) {
  const Vector3 middle(0.5 * (face.x_low + face.x_high), 0.5 * face.height, -0.5 * thickness);
  return poseOf(face.p_WF + face.R_WF * middle, face.R_WF);
}

std::array<double, 3> slabSize(const Face& face, double thickness) {
  return {face.x_high - face.x_low, face.height, thickness};
}

}  // namespace

std::vector<ReportPhase> contactPhases(const RunLog& log) {
  std::vector<ReportPhase> phases;
  for (const TruthFrame& truth : log.truth) {
    if (truth.contact_phase == ContactPhase::kNone) continue;
    const double t = toSeconds(truth.time);
    if (phases.empty() || t - phases.back().end_s > kBridged_s) {
      phases.push_back({ReportPhase::Kind::kContact, t, t, "contact"});
    }
    phases.back().end_s = t;
  }
  return phases;
}

std::optional<PlotGroup> contactGroup(const RunLog& log, const RobotParameters& robot,
                                      const SurroundingsParameters& surroundings) {
  PlotSeries asked{"asked for", SeriesStyle::kReference, 0, {}, {}};
  PlotSeries force{"true", SeriesStyle::kMeasured, 0, {}, {}};
  PlotSeries sensed{"sensed by the arm", SeriesStyle::kMeasured, 1, {}, {}};
  PlotSeries across{"across, true", SeriesStyle::kMeasured, 2, {}, {}};
  PlotSeries shift{"true", SeriesStyle::kMeasured, 0, {}, {}};
  PlotSeries balance{"static balance", SeriesStyle::kReference, 0, {}, {}};
  PlotSeries door{"door", SeriesStyle::kMeasured, 3, {}, {}};
  bool any = false;
  Vector3 along = Vector3::Zero();
  for (const PlanFrame& plan : log.plans) {
    if (plan.contact_asked_W.norm() > kSmallest_N) {
      along = plan.contact_asked_W.normalized();
      break;
    }
  }
  Newest<PlanFrame> plans(log.plans);
  Newest<EstimateFrame> estimates(log.estimates);
  for (const TruthFrame& truth : log.truth) {
    const auto* plan = plans.at(truth.time);
    const auto* estimate = estimates.at(truth.time);
    const Vector3 wanted = plan ? plan->contact_asked_W : Vector3::Zero();
    if (wanted.norm() > kSmallest_N) along = wanted.normalized();
    any = any || truth.contact_phase != ContactPhase::kNone || wanted.norm() > kSmallest_N;
    const Vector3 along_now = along.isZero(0) ? Vector3(-Vector3::UnitX()) : along;
    const double normal = truth.contact_force_W.dot(along_now);
    const Vector3 push = Vector3(-along_now.x(), -along_now.y(), 0).normalized();
    const Lean lean = leanOf(robot, truth, push);
    for (PlotSeries* s : {&asked, &force, &sensed, &across, &shift, &balance, &door}) {
      s->t.push_back(toSeconds(truth.time));
    }
    asked.values.push_back(wanted.norm());
    force.values.push_back(normal);
    sensed.values.push_back(estimate ? estimate->contact_force_W.dot(along_now) : 0);
    across.values.push_back((truth.contact_force_W - normal * along_now).norm());
    shift.values.push_back(1e3 * lean.shift);
    balance.values.push_back(1e3 * lean.balanced_shift);
    door.values.push_back(kDegPerRad * truth.door_angle);
  }
  if (!any) return std::nullopt;
  PlotGroup group{
      "Contact",
      "Force on the end-effector along the one asked for. The robot leans until its "
      "centre of mass stands so far before the ball that its weight balances the force.",
      {},
      {}};
  group.axes.push_back({"force", "N", {sensed, asked, force, across}, {}});
  group.axes.push_back({"COM before ball", "mm", {balance, shift}, {}});
  if (surroundings.door) group.axes.push_back({"door angle", "deg", {door}, {}});
  return group;
}

std::vector<ReplayObject> replayObjects(const RunLog& log,
                                        const SurroundingsParameters& surroundings) {
  std::vector<ReplayObject> objects;
  if (surroundings.wall) {
    const Face face = wallFace(*surroundings.wall);
    objects.push_back({"wall", slabSize(face, kWallThickness), {slabBehind(face, kWallThickness)}});
  }
  if (surroundings.door) {
    const DoorParameters& p = *surroundings.door;
    ReplayObject leaf{"door", slabSize(doorFace(p, {}), p.thickness), {}};
    for (const TruthFrame& truth : log.truth) {
      leaf.poses.push_back(slabBehind(doorFace(p, {truth.door_angle, 0}), p.thickness));
    }
    objects.push_back(std::move(leaf));
    // The post it hangs on, so that one sees which side that is.
    constexpr double kPost = 0.06;
    objects.push_back(
        {"door post",
         {kPost, kPost, p.height},
         {poseOf(Vector3(p.hinge.x(), p.hinge.y(), 0.5 * p.height), Matrix3::Identity())}});
  }
  return objects;
}

}  // namespace ballbot
