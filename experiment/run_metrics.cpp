#include "experiment/run_metrics.hpp"

#include "experiment/believed_robot.hpp"
#include "plant/environment.hpp"
#include "plant/surroundings.hpp"

namespace ballbot {
namespace {

std::vector<PushMetrics::Interval> pushIntervals(const Scenario& scenario, const HomeFrame& home) {
  const Matrix3 to_home = home.R_WH().transpose();
  std::vector<PushMetrics::Interval> out;
  for (const Push& push : scheduledPushes(scenario.tree)) {
    out.push_back({push.start, push.end(), (to_home * push.force_W).head<2>()});
  }
  return out;
}

ContactMetrics contactMetrics(const Scenario& scenario) {
  const auto door = surroundingsOf(scenario.tree).door;
  if (!door) return ContactMetrics(scenarioRobot(scenario));
  return ContactMetrics(scenarioRobot(scenario), door->opening_limit);
}

}  // namespace

RunMetrics::RunMetrics(const Scenario& scenario)
    : reference_(readEeReference(scenario)),
      balance_(scenario.release),
      push_(pushIntervals(scenario, reference_.home), scenario.release),
      motion_(scenario),
      steps_(reference_.steps(), scenario.release, kSimStart + scenario.duration),
      contact_(contactMetrics(scenario)),
      estimation_(scenario.release) {}

void RunMetrics::add(const Tick& tick, const RobotController& controller) {
  if (!tick.truth) return;
  const TruthFrame truth = reference_.home.see(*tick.truth);
  balance_.add(truth, tick.control.command);
  push_.add(truth, motion_.place(truth.time));
  motion_.add(truth, tick.control.command);
  steps_.add(truth, reference_.at(truth.time));
  contact_.add(truth, tick.control.plan.contact_asked_W, tick.control.estimate.contact_force_W);
  if (!tick.control.has_estimate) return;
  estimation_.add(truth, tick.control.estimate.state);
  if (const auto own = controller.estimator().selfAssessment()) estimation_.addConsistency(*own);
}

std::map<std::string, double> RunMetrics::values(const RobotController& controller) const {
  std::map<std::string, double> all = balance_.values();
  all.merge(push_.values());
  all.merge(motion_.values());
  all.merge(controller.feedforwardShare().values());
  all.merge(steps_.values());
  all.merge(contact_.values());
  all.merge(estimation_.values());
  all.merge(controller.counters());
  return all;
}

std::vector<std::string> RunMetrics::names(const RobotController& controller) {
  std::vector<std::string> all;
  for (const auto& names : {BalanceMetrics::names(), PushMetrics::names(), EeStepMetrics::names(),
                            ContactMetrics::names(), MotionMetrics::names(),
                            FeedforwardShare::names(), EstimationErrors::names()}) {
    all.insert(all.end(), names.begin(), names.end());
  }
  for (const auto& counter : controller.counters()) all.push_back(counter.first);
  all.push_back(kFallbackPercent);
  return all;
}

}  // namespace ballbot
