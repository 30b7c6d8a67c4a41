#include "tests/report/example_run.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "core/random.hpp"
#include "tests/report/pendulum.hpp"

namespace ballbot {

namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kStep_s = 2.5e-3, kDuration_s = 10;
constexpr int kSubsteps = 5;
constexpr double kRadToDeg = 180 / M_PI;

// The robot of configs/robots/ballbot.urdf, as far as the example needs it.
constexpr double kWheelRadius = 0.064, kWheelZenith = M_PI / 4;
constexpr std::array<double, 3> kNominalArm = {0, -0.6, 2.1707963267948966};
constexpr double kPushHeight = 0.35, kHandHeight = 0.953, kHandReach = 0.181;

struct Push {
  int axis;  // 0: along x, 1: along y
  double newton, start_s, end_s;
};
constexpr std::array<Push, 2> kPushes = {{{1, 20, 2, 2.5}, {0, 20, 5, 5.5}}};
constexpr double kWallStiffness = 900, kWallDamping = 25;  // [N/m, N s/m]
constexpr double kWallGap = 0.1;                           // from the hand at rest [m]

struct Instant {
  double t = 0;
  std::array<Pendulum, 2> plane;  // along x, along y
  std::array<double, 2> torque{};
  Vector3d push = Vector3d::Zero(), contact = Vector3d::Zero();
  Quaterniond ball = Quaterniond::Identity();
  Vector3d wheel_angle = Vector3d::Zero(), wheel_torque = Vector3d::Zero();
  Vector3d arm = Vector3d::Zero();
};

Quaterniond baseOrientation(const Instant& now) {
  return Quaterniond(AngleAxisd(now.plane[0].lean, Vector3d::UnitY()) *
                     AngleAxisd(-now.plane[1].lean, Vector3d::UnitX()));
}

Vector3d ballCentre(const Instant& now) {
  return {now.plane[0].x, now.plane[1].x, Pendulum::kBallRadius};
}

/// End-effector pose from the arm's geometry.
Eigen::Isometry3d handPose(const Instant& now) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(ballCentre(now));
  pose.rotate(baseOrientation(now));
  pose.translate(Vector3d(0, 0, 0.5)).rotate(AngleAxisd(now.arm[0], Vector3d::UnitZ()));
  pose.translate(Vector3d(0, 0, 0.08)).rotate(AngleAxisd(now.arm[1], Vector3d::UnitY()));
  pose.translate(Vector3d(0, 0, 0.3)).rotate(AngleAxisd(now.arm[2], Vector3d::UnitY()));
  pose.translate(Vector3d(0, 0, 0.35)).rotate(AngleAxisd(-M_PI / 2, Vector3d::UnitY()));
  return pose;
}

Vector3d wheelAxle(int i) {
  const double azimuth = i * 2 * M_PI / 3;
  return {std::cos(kWheelZenith) * std::cos(azimuth), std::cos(kWheelZenith) * std::sin(azimuth),
          -std::sin(kWheelZenith)};
}

double pushAlong(int axis, double t) {
  double newton = 0;
  for (const Push& push : kPushes) {
    if (push.axis == axis && t >= push.start_s && t < push.end_s) newton += push.newton;
  }
  return newton;
}

/// Spring and damper of the wall on the hand; it can only push back.
double wallForce(const Pendulum& along_x) {
  const double depth = along_x.x + kHandHeight * std::sin(along_x.lean) - kWallGap;
  if (depth <= 0) return 0;
  const double speed = along_x.v + kHandHeight * std::cos(along_x.lean) * along_x.rate;
  return std::min(0.0, -kWallStiffness * depth - kWallDamping * speed);
}

/// Ball, wheels and arm follow the two planes by rolling without slip.
void moveAlong(Instant& now, double h) {
  const Vector3d ball_rate(-now.plane[1].v / Pendulum::kBallRadius,
                           now.plane[0].v / Pendulum::kBallRadius, 0);
  const Vector3d base_rate(-now.plane[1].rate, now.plane[0].rate, 0);
  const double angle = ball_rate.norm() * h;
  if (angle > 0) now.ball = AngleAxisd(angle, ball_rate.normalized()) * now.ball;
  const double ratio = Pendulum::kBallRadius / kWheelRadius;
  const Vector3d ball_torque(-now.torque[1], now.torque[0], 0);
  for (int i = 0; i < 3; ++i) {
    now.wheel_angle[i] -= ratio * wheelAxle(i).dot(ball_rate - base_rate) * h;
    now.wheel_torque[i] = -wheelAxle(i).dot(ball_torque) / (ratio * 0.75);
  }
  // The arm swings against the lean, as a whole-body controller lets it.
  now.arm = Vector3d(0.6 * now.plane[1].x, kNominalArm[1] - 0.8 * now.plane[0].lean,
                     kNominalArm[2] + 0.9 * now.plane[0].lean);
}

std::vector<Instant> simulated() {
  std::vector<Instant> run;
  Instant now;
  now.plane[0].lean = 3 / kRadToDeg;
  const auto count = static_cast<std::size_t>(std::lround(kDuration_s / kStep_s));
  for (std::size_t i = 0; i <= count; ++i) {
    now.t = static_cast<double>(i) * kStep_s;
    now.push = Vector3d(pushAlong(0, now.t), pushAlong(1, now.t), 0);
    now.contact = Vector3d(wallForce(now.plane[0]), 0, 0);
    for (int axis = 0; axis < 2; ++axis) now.torque[axis] = now.plane[axis].balancingTorque();
    moveAlong(now, i == 0 ? 0 : kStep_s);
    run.push_back(now);
    for (int sub = 0; sub < kSubsteps; ++sub) {
      const double contact[2] = {wallForce(now.plane[0]), 0};
      for (int axis = 0; axis < 2; ++axis)
        now.plane[axis].step(kStep_s / kSubsteps, now.torque[axis],
                             {{{now.push[axis], kPushHeight}, {contact[axis], kHandHeight}}});
    }
  }
  return run;
}

template <typename Read>
std::vector<double> column(const std::vector<Instant>& run, Read read) {
  std::vector<double> values;
  values.reserve(run.size());
  for (const Instant& now : run) values.push_back(read(now));
  return values;
}

std::vector<double> noisy(std::vector<double> values, const char* name, double sigma) {
  const RandomStream noise(1, name);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += sigma * noise.normals(i)[0];
  return values;
}

ReplayPose toPose(const Vector3d& p, const Quaterniond& q) {
  return {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

ReportReplay replayOf(const std::vector<Instant>& run, const std::vector<double>& t) {
  ReportReplay replay;
  replay.t = t;
  ReplayBody base{"base", {}}, ball{"ball", {}};
  ReplayFrame hand{"end-effector", SeriesStyle::kMeasured, {}};
  ReplayFrame wanted{"reference", SeriesStyle::kReference, {}};
  ReplayForce push{"push", ReportPhase::Kind::kPush, {}, {}};
  ReplayForce contact{"contact", ReportPhase::Kind::kContact, {}, {}};
  Instant rest;
  rest.arm = Vector3d(kNominalArm[0], kNominalArm[1], kNominalArm[2]);
  for (const Instant& now : run) {
    const Quaterniond tilt = baseOrientation(now);
    const Vector3d centre = ballCentre(now);
    const Eigen::Isometry3d pose = handPose(now);
    const Vector3d pushed = centre + tilt * Vector3d(0, 0, kPushHeight);
    base.poses.push_back(toPose(centre, tilt));
    ball.poses.push_back(toPose(centre, now.ball));
    hand.poses.push_back(toPose(pose.translation(), Quaterniond(pose.rotation())));
    wanted.poses.push_back(
        toPose(handPose(rest).translation(), Quaterniond(handPose(rest).rotation())));
    push.point_W.push_back({pushed.x(), pushed.y(), pushed.z()});
    push.force_W.push_back({now.push.x(), now.push.y(), now.push.z()});
    contact.point_W.push_back(hand.poses.back().p_W);
    contact.force_W.push_back({now.contact.x(), now.contact.y(), now.contact.z()});
  }
  replay.bodies = {base, ball};
  replay.frames = {hand, wanted};
  replay.forces = {push, contact};
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i + 1);
    replay.joints.push_back({"wheel_" + number + "_joint",
                             column(run, [i](const Instant& n) { return n.wheel_angle[i]; })});
    replay.joints.push_back(
        {"arm_" + number + "_joint", column(run, [i](const Instant& n) { return n.arm[i]; })});
  }
  const double thickness = 0.04;
  const double face = kHandReach + kWallGap + 0.02;
  replay.objects = {{"wall",
                     {thickness, 1.2, 1.3},
                     {toPose({face + thickness / 2, 0, 0.65}, Quaterniond::Identity())}}};
  return replay;
}

PlotGroup ballFigure(const std::vector<Instant>& run, const std::vector<double>& t) {
  const std::vector<double> zero(t.size(), 0.0);
  PlotGroup group{"Ball", "The ball gives way to each push and returns to its place.", {}, {}};
  PathSeries way{"ball", SeriesStyle::kMeasured, 0, t, {}, {}};
  for (int axis = 0; axis < 2; ++axis) {
    const std::string name = axis == 0 ? "x" : "y";
    const auto x = column(run, [axis](const Instant& n) { return n.plane[axis].x; });
    const auto v = column(run, [axis](const Instant& n) { return n.plane[axis].v; });
    if (axis == 0) {
      group.axes.push_back({"position", "m", {}, {{"limit", 0.45}}});
      group.axes.push_back({"velocity", "m/s", {}, {}});
    }
    group.axes[0].series.push_back({name + " measured", SeriesStyle::kMeasured, axis, t, x});
    group.axes[0].series.push_back({name + " reference", SeriesStyle::kReference, axis, t, zero});
    group.axes[1].series.push_back(
        {name + " estimated", SeriesStyle::kEstimated, axis, t, noisy(v, name.c_str(), 0.006)});
    group.axes[1].series.push_back({name + " true", SeriesStyle::kMeasured, axis, t, v});
    (axis == 0 ? way.x : way.y) = x;
  }
  group.paths.push_back({"Seen from above", "x", "y", "m", {way}});
  return group;
}

PlotGroup bodyFigure(const std::vector<Instant>& run, const std::vector<double>& t) {
  PlotGroup group{"Base and wheels", "", {}, {}};
  group.axes.push_back({"tilt", "deg", {}, {{"limit", 20}, {"limit", -20}}});
  group.axes.push_back({"wheel torque", "N m", {}, {{"traction", 4}, {"traction", -4}}});
  group.axes[0].series = {
      {"pitch", SeriesStyle::kMeasured, 0, t,
       column(run, [](const Instant& n) { return n.plane[0].lean * kRadToDeg; })},
      {"roll", SeriesStyle::kMeasured, 1, t,
       column(run, [](const Instant& n) { return -n.plane[1].lean * kRadToDeg; })}};
  for (int i = 0; i < 3; ++i) {
    const auto torque = column(run, [i](const Instant& n) { return n.wheel_torque[i]; });
    const std::string name = "wheel " + std::to_string(i + 1);
    group.axes[1].series.push_back(
        {name, SeriesStyle::kMeasured, i, t, noisy(torque, name.c_str(), 0.03)});
    group.axes[1].series.push_back({name + " command", SeriesStyle::kCommanded, i, t, torque});
  }
  return group;
}

PlotGroup contactFigure(const std::vector<Instant>& run, const std::vector<double>& t) {
  PlotGroup group{"Contact at the end-effector", "Gaps: no contact, no force to measure.", {}, {}};
  const double none = std::numeric_limits<double>::quiet_NaN();
  group.axes.push_back(
      {"force on the hand",
       "N",
       {{"along x", SeriesStyle::kMeasured, 2, t,
         column(run,
                [none](const Instant& n) { return n.contact.x() < 0 ? n.contact.x() : none; })}},
       {}});
  return group;
}

std::vector<ReportPhase> phasesOf(const std::vector<Instant>& run) {
  std::vector<ReportPhase> phases;
  for (const Push& push : kPushes)
    phases.push_back({ReportPhase::Kind::kPush, push.start_s, push.end_s,
                      push.axis == 0 ? "20 N along x" : "20 N along y"});
  bool touching = false;
  for (const Instant& now : run) {
    const bool touches = now.contact.x() < 0;
    if (touches && !touching) phases.push_back({ReportPhase::Kind::kContact, now.t, now.t, "wall"});
    if (touches) phases.back().end_s = now.t;
    touching = touches;
  }
  return phases;
}

}  // namespace

ReportData exampleRun() {
  const std::vector<Instant> run = simulated();
  const std::vector<double> t = column(run, [](const Instant& n) { return n.t; });
  double largest_tilt = 0, largest_excursion = 0;
  for (const Instant& now : run) {
    largest_tilt = std::max(largest_tilt, std::hypot(now.plane[0].lean, now.plane[1].lean));
    largest_excursion = std::max(largest_excursion, std::hypot(now.plane[0].x, now.plane[1].x));
  }
  const double final_error = std::hypot(run.back().plane[0].x, run.back().plane[1].x);

  ReportData data;
  data.title = "Push recovery beside a wall";
  data.subtitle = "A push of 20 N for half a second along y, then one along x into a wall.";
  data.passed = true;
  data.verdict = "3 of 3 requirements met";
  data.headline = {{"Duration", "10 s"}, {"Seed", "1"}, {"Controller", "state feedback"}};
  data.requirements = {{"Largest tilt", largest_tilt * kRadToDeg, "< 20", "deg", true},
                       {"Largest ball excursion", largest_excursion, "< 0.45", "m", true},
                       {"Final ball position error", final_error, "< 0.1", "m", true}};
  data.metrics = {{"Balance", "Largest tilt", largest_tilt * kRadToDeg, "deg"},
                  {"Balance", "Largest ball excursion", largest_excursion, "m"},
                  {"Balance", "Falls", 0, ""},
                  {"Ball", "Final position error", final_error, "m"}};
  data.groups = {ballFigure(run, t), bodyFigure(run, t), contactFigure(run, t)};
  data.phases = phasesOf(run);
  data.replay = replayOf(run, t);
  data.manifest = {{"scenario", "example"},
                   {"trajectory_digest", "5f2b0c6e9d3a417885a6e2d10c9b47f3"},
                   {"seed", "1"}};
  data.documents = {{"Scenario", "name: example\nduration_s: 10\nseed: 1\n"}};
  data.start_s = 0;
  data.end_s = kDuration_s;
  return data;
}

std::string exampleUrdf() {
  std::ifstream file(BALLBOT_SOURCE_DIR "/configs/robots/ballbot.urdf");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace ballbot
