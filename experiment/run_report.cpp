#include "experiment/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/key_unit.hpp"
#include "cosim/log_reader.hpp"
#include "experiment/axes_builder.hpp"
#include "experiment/build_info.hpp"
#include "experiment/contact_report.hpp"
#include "experiment/floor_report.hpp"
#include "experiment/log_tables.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/run_replay.hpp"
#include "experiment/scenario_frame.hpp"
#include "experiment/text_file.hpp"
#include "metrics/balance_metrics.hpp"
#include "metrics/ee_step_metrics.hpp"
#include "report/write_report.hpp"

namespace ballbot {
namespace {

/// Dashed, where the tasks ask for a place of the ball.
void addBallReference(const LogTable& truth, const MotionReference& reference, PlotGroup& group) {
  const std::vector<double>& t = truth.column("time_s");
  std::vector<double> asked[2];
  bool any[2] = {false, false};
  for (const double time : t) {
    const PlaceReference place = reference.place(kSimStart + durationFromSeconds(time));
    for (int i = 0; i < 2; ++i) {
      any[i] = any[i] || place.ball_asked[i] > 0;
      asked[i].push_back(place.ball[i]);
    }
  }
  for (int i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "x reference" : "y reference";
    if (any[i]) group.axes[0].series.push_back({name, SeriesStyle::kReference, i, t, asked[i]});
  }
  if (any[0] && any[1]) {
    group.paths[0].series.push_back(
        {"reference", SeriesStyle::kReference, 1, t, asked[0], asked[1]});
  }
}

PlotGroup ballGroup(const std::vector<LogTable>& tables, const MotionReference& reference) {
  PlotGroup group{"Ball", "Where the ball is and what the controller believes.", {}, {}};
  AxesBuilder position(tables, "position", "m");
  AxesBuilder velocity(tables, "velocity", "m/s");
  int channel = 0;
  for (const char* axis : {"x", "y"}) {
    addBoth(position, std::string("ball_position_W_") + axis, axis, channel);
    addBoth(velocity, std::string("ball_velocity_W_") + axis, axis, channel);
    ++channel;
  }
  group.axes = {position.axes(), velocity.axes()};
  if (const LogTable* truth = findTable(tables, "truth")) {
    PathAxes path{"Way of the ball from above", "x", "y", "m", {}};
    path.series.push_back({"ball", SeriesStyle::kMeasured, 0, truth->column("time_s"),
                           truth->column("ball_position_W_x"), truth->column("ball_position_W_y")});
    group.paths.push_back(std::move(path));
    addBallReference(*truth, reference, group);
  }
  return group;
}

PlotGroup baseGroup(const std::vector<LogTable>& tables) {
  PlotGroup group{"Base",
                  "The base leans against a push and into an acceleration; at rest it leans so far "
                  "that the whole is in balance, 1.2 degrees at the nominal arm pose.",
                  {},
                  {}};
  AxesBuilder angles(tables, "angle", "deg", kDegPerRad);
  AxesBuilder rates(tables, "angular velocity", "rad/s");
  const char* const names[] = {"pitch", "roll", "yaw"};
  const char* const axes[] = {"y", "x", "z"};
  for (int i = 0; i < 3; ++i) {
    addBoth(angles, std::string("base_angles_") + names[i], names[i], i);
    addBoth(rates, std::string("base_rate_B_") + axes[i], axes[i], i);
  }
  group.axes = {angles.axes(), rates.axes()};
  return group;
}

PlotGroup torqueGroup(const std::vector<LogTable>& tables, const RobotParameters& robot) {
  PlotGroup group{"Torques", "Commanded, and what the springs apply.", {}, {}};
  AxesBuilder wheels(tables, "wheel torque", "N m"), arms(tables, "arm torque", "N m");
  const auto addBoth = [](AxesBuilder& axes, const char* joint, const char* words, int i) {
    axes.line("truth", fmt::format("joint_torque_{}{}", joint, i + 1),
              fmt::format("{} {}", words, i + 1), SeriesStyle::kMeasured, i)
        .line("command", fmt::format("torque_{}{}", joint, i + 1),
              fmt::format("{} {} commanded", words, i + 1), SeriesStyle::kCommanded, i);
  };
  for (int i = 0; i < kWheelCount; ++i) addBoth(wheels, "wheel", "wheel", i);
  for (int i = 0; i < kArmJointCount; ++i) addBoth(arms, "arm", "joint", i);
  wheels.limit("limit", robot.wheel_torque_limit);
  group.axes = {wheels.axes(), arms.axes()};
  return group;
}

/// The end-effector's pose with its reference, where there is one.
PlotGroup handGroup(const RunLog& log, const MotionReference& reference) {
  PlotGroup group{"End-effector", reference.eeMoves() ? "Dashed: what was asked for." : "", {}, {}};
  PlotAxes position{"position", "m", {}, {}}, angles{"orientation", "deg", {}, {}};
  const char* const names[kPoseDim] = {"x", "y", "z", "yaw", "pitch", "roll"};
  for (int i = 0; i < kPoseDim; ++i) {
    PlotSeries measured{names[i], SeriesStyle::kMeasured, i % 3, {}, {}};
    PlotSeries asked{std::string(names[i]) + " reference", SeriesStyle::kReference, i % 3, {}, {}};
    const double scale = i < 3 ? 1 : kDegPerRad;
    for (const TruthFrame& truth : log.truth) {
      measured.t.push_back(toSeconds(truth.time));
      const PoseVector wanted = reference.eePose(truth.time);
      measured.values.push_back(scale * eePose(truth, wanted)[i]);
      asked.values.push_back(scale * wanted[i]);
    }
    asked.t = measured.t;
    PlotAxes& axes = i < 3 ? position : angles;
    if (reference.eeMoves()) axes.series.push_back(std::move(asked));
    axes.series.push_back(std::move(measured));
  }
  group.axes = {std::move(position), std::move(angles)};
  return group;
}

PlotGroup armGroup(const std::vector<LogTable>& tables) {
  PlotGroup group{"Arm", "", {}, {}};
  AxesBuilder joints(tables, "joint angle", "rad");
  for (int i = 0; i < kArmJointCount; ++i) {
    joints.line("truth", fmt::format("arm_angle_arm{}", i + 1), fmt::format("joint {}", i + 1),
                SeriesStyle::kMeasured, i);
  }
  group.axes = {joints.axes()};
  return group;
}

/// What plans cost, and of what; nothing for laws that solve nothing.
std::optional<PlotGroup> planGroup(const std::vector<LogTable>& tables) {
  const LogTable* plan = findTable(tables, "plan");
  if (!plan) return std::nullopt;
  const std::string prefix = "cost_";
  std::vector<std::pair<double, std::string>> shares;  // of all columns that are terms of the cost
  for (const LogTable::Column& column : plan->columns) {
    if (column.name.rfind(prefix, 0) != 0) continue;
    double sum = 0;
    for (const double v : column.values) sum += std::abs(v);
    if (sum > 0) shares.push_back({sum, column.name});
  }
  if (shares.empty()) return std::nullopt;
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  shares.resize(std::min<std::size_t>(shares.size(), 4));
  AxesBuilder cost(tables, "cost of the plan", "");
  cost.line("plan", "cost", "whole", SeriesStyle::kMeasured, 0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    cost.line("plan", shares[i].second, shares[i].second.substr(prefix.size()),
              SeriesStyle::kMeasured, static_cast<int>(i) + 1);
  }
  return PlotGroup{
      "Plans", "What the planned motion costs, and its largest parts.", {cost.axes()}, {}};
}

constexpr int kChannels = 6;  // colours of a pair of axes

/// Sensors beside those of every robot, one pair of axes for each unit.
std::optional<PlotGroup> addedSensorGroup(const RunLog& log, const std::vector<LogTable>& tables) {
  if (log.added[AddedTo::kSensors].list.empty()) return std::nullopt;
  PlotGroup group{"Added sensors", "", {}, {}};
  std::map<std::string, AxesBuilder> by_unit;
  std::map<std::string, int> channels;
  for (const AddedSignal& signal : log.added[AddedTo::kSensors].list) {
    auto& axes = by_unit.try_emplace(signal.unit, tables, "value", signal.unit).first->second;
    axes.line("sensors", signal.name, signal.name, SeriesStyle::kMeasured,
              channels[signal.unit]++ % kChannels);
  }
  for (const auto& axes : by_unit) group.axes.push_back(axes.second.axes());
  return group;
}

std::vector<ReportPhase> phasesOf(const RunConfig& config) {
  const Scenario& scenario = config.scenario;
  std::vector<ReportPhase> phases;
  if (scenario.release > kSimStart) {
    phases.push_back(
        {ReportPhase::Kind::kHold, 0, toSeconds(scenario.release), "held in the stand"});
  }
  for (const Push& push : config.plant.plant.pushes) {
    phases.push_back({ReportPhase::Kind::kPush, toSeconds(push.start),
                      toSeconds(push.start + push.duration),
                      fmt::format("push {:.0f} N", push.force_W.norm())});
  }
  for (const Fault& fault : config.plant.plant.faults) {
    phases.push_back(
        {ReportPhase::Kind::kFault, toSeconds(fault.start), toSeconds(fault.end()), toText(fault)});
  }
  return phases;
}

std::string verdictText(const RunResult& result) {
  if (result.fell) return fmt::format("fell at {:.2f} s", toSeconds(result.end));
  if (result.no_plan_acted) {
    return "no plan ever acted" +
           (result.plan_trouble.empty() ? "" : fmt::format(" ({})", result.plan_trouble));
  }
  std::size_t met = 0;
  for (const VerdictRow& row : result.verdicts) met += row.passed ? 1 : 0;
  return fmt::format("{} of {} requirements met", met, result.verdicts.size());
}

void addVerdicts(const RunResult& result, ReportData& data) {
  for (const VerdictRow& row : result.verdicts) {
    data.requirements.push_back({row.metric, row.measured ? row.value : std::nan(""), row.limit,
                                 unitOfKey(row.metric), row.passed});
  }
  for (const auto& [name, value] : result.metrics) {
    if (name.rfind("rejected_", 0) != 0) data.metrics.push_back({"", name, value, unitOfKey(name)});
  }
  for (const auto& [reason, count] : rejectionsAmong(result.metrics)) {
    data.metrics.push_back({"Rejected by the estimator", reason, count, ""});
  }
}

}  // namespace

void writeRunReport(const RunConfig& config, const RunResult& result, const RunFolder& folder) {
  const Scenario& scenario = config.scenario;
  // Plots show what the controller was asked for and believed: in its frame. The scene is in W.
  const RunLog log_W = readRunLog(folder.logFile());
  RunLog log = log_W;
  const auto reference = config.reference();
  seeFromHome(config.home, log);
  const std::vector<LogTable> tables = logTables(log);
  const RobotParameters& robot = config.robot;

  ReportData data;
  data.title = scenario.name;
  data.subtitle = scenario.summary;
  data.passed = result.passed;
  data.verdict = verdictText(result);
  data.headline = {
      {"duration", fmt::format("{:g} s", toSeconds(result.end))},
      {"seed", std::to_string(scenario.seed)},
      {"digest", result.trajectory_digest.substr(0, 12)},
      {"largest tilt", fmt::format("{:.1f} deg", result.metrics.count("largest_tilt_deg")
                                                     ? result.metrics.at("largest_tilt_deg")
                                                     : std::nan(""))}};
  addVerdicts(result, data);
  data.groups = {ballGroup(tables, *reference), baseGroup(tables), handGroup(log, *reference),
                 torqueGroup(tables, robot), armGroup(tables)};
  if (auto floor = floorGroup(tables)) data.groups.push_back(std::move(*floor));
  if (auto wheels = wheelGroup(tables)) data.groups.push_back(std::move(*wheels));
  if (auto plans = planGroup(tables)) data.groups.push_back(std::move(*plans));
  if (auto added = addedSensorGroup(log, tables)) data.groups.push_back(std::move(*added));
  const SurroundingsParameters& surroundings = config.plant.plant.surroundings;
  if (auto contact = contactGroup(log, robot, surroundings)) {
    data.groups.insert(data.groups.begin(), std::move(*contact));
  }
  data.phases = phasesOf(config);
  for (ReportPhase& phase : contactPhases(log)) data.phases.push_back(std::move(phase));
  if (!log.truth.empty()) {
    data.replay = makeReplay(log_W, robot, ReplayNames::of(config), config.plant.plant.pushes,
                             *reference, config.home);
    data.replay->objects = replayObjects(log_W, surroundings);
  }
  data.manifest = {{"scenario", scenario.name},
                   {"seed", std::to_string(scenario.seed)},
                   {"config digest", scenario.configDigest()},
                   {"trajectory digest", result.trajectory_digest}};
  for (const auto& [key, value] : buildInfo()) data.manifest.push_back({key, value});
  data.documents = {{"scenario.yaml", readTextFile(folder.scenarioFile())},
                    {"summary.json", readTextFile(folder.summaryFile())}};
  data.start_s = 0;
  data.end_s = toSeconds(result.end);
  writeReport(data, readTextFile(scenario.urdf_path), folder.reportFile());
}

}  // namespace ballbot
