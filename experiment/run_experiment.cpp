#include "experiment/run_experiment.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/foreign_code.hpp"
#include "cosim/recorder.hpp"
#include "cosim/step_master.hpp"
#include "experiment/checkpoint_files.hpp"
#include "experiment/plant_factory.hpp"
#include "experiment/plant_link.hpp"
#include "experiment/robot_controller.hpp"
#include "experiment/run_metrics.hpp"
#include "experiment/run_record.hpp"
#include "experiment/run_report.hpp"
#include "experiment/scenario_variants.hpp"

namespace ballbot {
namespace {

using WallTime = std::chrono::steady_clock;

std::int64_t wallNs() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(WallTime::now().time_since_epoch())
      .count();
}

/// Leaves a checkpoint at the first event at or after each multiple of a period.
class CheckpointKeeper {
 public:
  CheckpointKeeper(SimDuration period, const RunFolder& folder)
      : period_(period), folder_(folder) {}

  void startAt(SimTime start) {
    if (period_ > SimDuration::zero()) next_ = firstAfter(start);
  }
  /// Between two events.
  void consider(const StepMaster& master) {
    if (master.time() < next_) return;
    writeCheckpoint(master.save(), folder_);
    next_ = firstAfter(master.time());
  }

 private:
  SimTime firstAfter(SimTime t) const {
    return kSimStart + ((t - kSimStart) / period_ + 1) * period_;
  }

  SimDuration period_;
  const RunFolder& folder_;
  SimTime next_ = SimTime::max();
};

/// Whether the requirements ask for a fall (`fell: {above: 0}`): an experiment that is to show that
/// a controller fails. Only then may a run that fell pass.
bool askForFall(const std::vector<MetricLimit>& requirements) {
  return std::any_of(requirements.begin(), requirements.end(), [](const MetricLimit& r) {
    return r.metric == "fell" && r.above && *r.above >= 0;
  });
}

std::unique_ptr<SteppedController> makeController(const RunConfig& config, EventCalendar& calendar,
                                                  const ControllerMaker& make) {
  if (!make) return std::make_unique<RobotController>(config, calendar);
  return doneBy("RunOptions::make_controller", [&] {
    auto made = make(config, calendar);
    if (!made) throw std::logic_error("it made nothing");
    return made;
  });
}

/// Every metric that a run can have. @throw InputError if one is asked for that it cannot have.
std::vector<std::string> knownMetrics(const RunConfig& config,
                                      const SteppedController& controller) {
  std::vector<std::string> known = RunMetrics::names();
  for (const std::string& name : controller.metricNames()) known.push_back(name);
  judge(config.scenario.requirements, {}, known);
  return known;
}

PlantLink::Options linkOptions(const RunOptions& options, int core) {
  PlantLink::Options link;
  link.in_process = options.in_process;
  link.shared = options.live;
  link.address = {options.lcm_url, options.channel};
  link.core = core;
  link.patience = options.patience;
  link.stop = options.stop;
  link.say = options.say;
  return link;
}

/// A run passes if it ended as it should, planned, and met every requirement.
bool passes(const RunResult& result, const std::vector<MetricLimit>& requirements) {
  if (result.no_plan_acted) return false;
  for (const VerdictRow& row : result.verdicts) {
    if (!row.passed) return false;
  }
  return result.fell ? askForFall(requirements) : result.completed;
}

/// Which of the costs that were added to a plan is not finite, in words; empty: none.
std::string notFiniteIn(const Tick& tick) {
  const AddedSignals* plan = tick.added[AddedTo::kPlan];
  if (!tick.control.has_plan || plan == nullptr) return "";
  const AddedSignals& added = *plan;
  for (std::size_t i = 0; i < added.values.size(); ++i) {
    if (!std::isfinite(added.values[i])) return added.list[i].words + " is not finite";
  }
  return "";
}

/// Saves, kills the plant, starts another and continues, between two events.
void replacePlant(StepMaster& master, PlantLink& plant) {
  const StateBlob saved = master.save().toBlob();
  plant.replace();
  master.replaceParticipant(plant.participant());
  master.restore(Checkpoint::fromBlob(saved));
}

}  // namespace

std::vector<std::string> checkScenario(const Scenario& scenario) {
  const RunConfig config = readRunConfig(scenario);
  EventCalendar calendar(scenario.rates.base_step);
  return knownMetrics(config, RobotController(config, calendar));
}

namespace {

/// The run itself, everything about the scenario being said already.
RunResult runInFolder(const RunConfig& config, const RunFolder& folder, const RunOptions& options,
                      EventCalendar& calendar, SteppedController& controller,
                      const std::vector<std::string>& known_metrics) {
  const Scenario& scenario = config.scenario;
  RunMetrics metrics(config);
  const int core = options.pin && !options.in_process ? preferredCore() : -1;
  if (core >= 0) pinToCore(core);
  PlantLink plant(config, folder, linkOptions(options, core));

  controller.setWallClock(wallNs);
  std::vector<PlanTiming> plan_times;
  plan_times.reserve(static_cast<std::size_t>(scenario.duration / scenario.rates.planner) + 1);
  RecorderOptions log = config.recording.log;
  log.log_path = folder.logFile();
  Recorder recorder(log);

  MasterOptions master_options;
  if (options.start) master_options.start = options.start->time;
  master_options.end = kSimStart + scenario.duration;
  master_options.stop = options.stop;
  StepMaster master(plant.participant(), controller, calendar, &recorder, master_options);
  std::string plan_trouble;
  master.setObserver([&](const Tick& tick) {
    if (plan_trouble.empty()) plan_trouble = notFiniteIn(tick);
    metrics.add(tick);
    if (tick.control.has_plan) plan_times.push_back(tick.control.plan_timing);
    if (options.progress) options.progress(tick.time);
    return !metrics.fell();
  });

  const auto started = WallTime::now();
  if (options.start) {
    master.restore(*options.start);
  } else {
    master.initialize();
  }
  CheckpointKeeper checkpoints(config.recording.checkpoint_period, folder);
  checkpoints.startAt(master.time());
  bool replaced = toNs(options.replace_plant_at) < 0;
  do {
    checkpoints.consider(master);
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
  result.log_digest = recorder.logDigest();
  result.metrics = metrics.values();
  result.metrics.merge(controller.metrics());
  result.verdicts = judge(scenario.requirements, result.metrics, known_metrics);
  const auto fallback = result.metrics.find(kFallbackPercent);
  result.no_plan_acted = fallback != result.metrics.end() && fallback->second == 100;
  result.plan_trouble = plan_trouble;
  result.passed = passes(result, scenario.requirements);

  writeSummary(scenario, result, folder);
  writeTiming(result, plant.statistics(), plan_times, recorder.bytesWritten(), folder);
  if (options.write_report) writeRunReport(config, result, folder);
  return result;
}

}  // namespace

RunResult runExperiment(const Scenario& scenario, const std::string& out,
                        const RunOptions& options) {
  // Everything that can be wrong with the scenario is said before anything is started.
  const RunConfig config = readRunConfig(scenario);
  EventCalendar calendar(scenario.rates.base_step);
  const auto controller = makeController(config, calendar, options.make_controller);
  const std::vector<std::string> known_metrics = knownMetrics(config, *controller);

  const RunFolder folder = RunFolder::create(out, scenario.name);
  writeScenario(scenario, folder.path());
  writeManifest(scenario, folder,
                options.start ? std::optional<SimTime>(options.start->time) : std::nullopt);
  if (options.start) writeStart(*options.start, folder);
  if (options.started) options.started(folder);

  try {
    return runInFolder(config, folder, options, calendar, *controller, known_metrics);
  } catch (const InputError&) {  // what a plant of its own finds wrong, it finds before it starts
    folder.discardUnlessRecorded();
    throw;
  }
}

void servePlant(const Scenario& scenario, const LcmAddress& address, ServeOptions options) {
  const std::unique_ptr<Participant> plant = makePlant(readPlantSetup(scenario));
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
