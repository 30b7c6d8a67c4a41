#include "experiment/run_experiment.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/config_reader.hpp"
#include "cosim/recorder.hpp"
#include "cosim/step_master.hpp"
#include "experiment/ee_reference.hpp"
#include "experiment/estimate_log.hpp"
#include "experiment/motion_metrics.hpp"
#include "experiment/plant_link.hpp"
#include "experiment/robot_controller.hpp"
#include "experiment/run_record.hpp"
#include "experiment/run_report.hpp"
#include "messages/convert.hpp"
#include "metrics/balance_metrics.hpp"
#include "metrics/contact_metrics.hpp"
#include "metrics/ee_step_metrics.hpp"
#include "metrics/estimation_errors.hpp"
#include "metrics/push_metrics.hpp"
#include "model/robot_reader.hpp"
#include "plant/environment.hpp"

namespace ballbot {
namespace {

using WallTime = std::chrono::steady_clock;

std::int64_t wallNs() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(WallTime::now().time_since_epoch())
      .count();
}

RecorderOptions readRecorderOptions(const Scenario& scenario, const std::string& log_path) {
  RecorderOptions options;
  options.log_path = log_path;
  options.sensors = options.estimate = scenario.rates.estimator;
  if (const ConfigNode* node = scenario.tree.find("recording")) {
    ConfigReader in(*node, "recording");
    options.read(in);
    in.finish();
  }
  return options;
}

/// Every metric that a run of this controller can produce.
std::vector<std::string> knownMetrics(const RobotController& controller) {
  std::vector<std::string> names = BalanceMetrics::names();
  for (const std::string& name : PushMetrics::names()) names.push_back(name);
  for (const std::string& name : EeStepMetrics::names()) names.push_back(name);
  for (const std::string& name : ContactMetrics::names()) names.push_back(name);
  for (const std::string& name : MotionMetrics::names()) names.push_back(name);
  for (const std::string& name : FeedforwardShare::names()) names.push_back(name);
  for (const std::string& name : EstimationErrors::names()) names.push_back(name);
  for (const auto& counter : controller.counters()) names.push_back(counter.first);
  return names;
}

std::vector<PushMetrics::Interval> pushIntervals(const Scenario& scenario) {
  std::vector<PushMetrics::Interval> out;
  for (const Push& push : scheduledPushes(scenario.tree))
    out.push_back({push.start, push.end(), push.force_W.head<2>()});
  return out;
}

/// Whether the requirements ask for a fall (`fell: {above: 0}`): an experiment that is to show that
/// a controller fails. Only then may a run that fell pass.
bool askForFall(const std::vector<MetricLimit>& requirements) {
  return std::any_of(requirements.begin(), requirements.end(), [](const MetricLimit& r) {
    return r.metric == "fell" && r.above && *r.above >= 0;
  });
}

/// Saves, kills the plant, starts another and continues, between two events.
void replacePlant(StepMaster& master, PlantLink& plant) {
  const StateBlob saved = master.save().toBlob();
  plant.replace();
  master.replaceParticipant(plant.participant());
  master.restore(Checkpoint::fromBlob(saved));
}

}  // namespace

RunResult runExperiment(const Scenario& scenario, const std::string& out,
                        const RunOptions& options) {
  // Everything that can be wrong with the scenario is said before anything is started.
  EventCalendar calendar(scenario.rates.base_step);
  RobotController controller(scenario, calendar);
  const std::vector<std::string> known_metrics = knownMetrics(controller);
  judge(scenario.requirements, {}, known_metrics);
  readRecorderOptions(scenario, "");
  checkPlant(scenario);
  const EeReference reference = readEeReference(scenario);

  const RunFolder folder = RunFolder::create(out, scenario.name);
  writeScenario(scenario, folder.path());
  writeManifest(scenario, folder);
  if (options.started) options.started(folder);

  const int core = options.pin && !options.in_process ? preferredCore() : -1;
  if (core >= 0) pinToCore(core);
  PlantLink::Options link;
  link.in_process = options.in_process;
  link.shared = options.live;
  link.address = {options.lcm_url, options.channel};
  link.core = core;
  link.patience = options.patience;
  link.stop = options.stop;
  PlantLink plant(scenario, folder, link);

  const auto planned_plans =
      static_cast<std::size_t>(scenario.duration / scenario.rates.planner) + 1;
  controller.timePlans(wallNs, planned_plans);
  Recorder recorder(readRecorderOptions(scenario, folder.logFile()));
  ConfigReader robot_in(scenario.section("robot"), "robot");
  BalanceMetrics metrics(scenario.release);
  PushMetrics push_metrics(pushIntervals(scenario));
  EstimationErrors estimation_errors = makeEstimationErrors(scenario);
  ContactMetrics contact_metrics(readRobot(robot_in));
  MotionMetrics motion_metrics(scenario);
  EeStepMetrics step_metrics(reference.initial, reference.steps, kSimStart + scenario.duration);

  MasterOptions master_options;
  master_options.end = kSimStart + scenario.duration;
  master_options.stop = options.stop;
  StepMaster master(plant.participant(), controller, calendar, &recorder, master_options);
  master.setObserver([&](const Tick& tick) {
    if (tick.truth) {
      metrics.add(*tick.truth, tick.control.command);
      push_metrics.add(*tick.truth);
      motion_metrics.add(*tick.truth, tick.control.command);
      step_metrics.add(*tick.truth);
      contact_metrics.add(*tick.truth, Eigen::Map<const Vector3>(tick.control.plan.contact_asked_W),
                          Eigen::Map<const Vector3>(tick.control.estimate.contact_force_W));
      if (tick.control.has_estimate) {
        estimation_errors.add(*tick.truth, stateOf(tick.control.estimate));
        if (const auto own = controller.estimator().selfAssessment()) {
          estimation_errors.addConsistency(*own);
        }
      }
    }
    if (options.progress) options.progress(tick.time);
    return !metrics.fell();
  });

  const auto started = WallTime::now();
  master.initialize();
  bool replaced = toNs(options.replace_plant_at) < 0;
  do {
    if (!replaced && master.time() >= options.replace_plant_at) {
      replacePlant(master, plant);
      replaced = true;
    }
  } while (master.step());
  master.terminate();
  const double wall = std::chrono::duration<double>(WallTime::now() - started).count();
  recorder.close();
  plant.close();

  RunResult result(folder);
  result.wall_seconds = wall;
  result.end = master.time();
  result.completed = master.ended() == StepMaster::End::kDuration;
  result.fell = metrics.fell();
  result.trajectory_digest = recorder.trajectoryDigest();
  result.metrics = metrics.values();
  for (const auto& value : push_metrics.values()) result.metrics.insert(value);
  for (const auto& value : motion_metrics.values()) result.metrics.insert(value);
  for (const auto& value : controller.feedforwardShare().values()) result.metrics.insert(value);
  for (const auto& value : step_metrics.values()) result.metrics.insert(value);
  for (const auto& value : contact_metrics.values()) result.metrics.insert(value);
  for (const auto& value : estimation_errors.values()) result.metrics.insert(value);
  for (const auto& counter : controller.counters()) result.metrics.insert(counter);
  result.verdicts = judge(scenario.requirements, result.metrics, known_metrics);
  result.passed = result.fell ? askForFall(scenario.requirements) : result.completed;
  for (const VerdictRow& row : result.verdicts) result.passed = result.passed && row.passed;

  writeSummary(scenario, result, folder);
  writeTiming(result, plant.statistics(), controller.planTimes(), recorder.bytesWritten(), folder);
  if (options.write_report) writeRunReport(scenario, result, folder);
  return result;
}

void servePlant(const Scenario& scenario, const LcmAddress& address, ServeOptions options) {
  const std::unique_ptr<Participant> plant = makePlant(scenario);
  {
    LcmTransport master_end(address, LinkEnd::kMaster);
    if (const auto who = whoServes(master_end)) {
      throw InputError("'" + *who + "' already serves " + master_end.describe() +
                       ". Give this one another --channel, or end that one first");
    }
  }
  LcmTransport transport(address, LinkEnd::kParticipant);
  options.config_digest = configDigest64(scenario);
  serve(*plant, transport, options);
}

}  // namespace ballbot
