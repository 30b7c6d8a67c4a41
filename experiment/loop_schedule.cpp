#include "experiment/loop_schedule.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr SimDuration kLongestPeriod = std::chrono::seconds(10);
constexpr int kPeriodsToSettle = 64;

/// What of the past decides what happens next.
struct Clockwork {
  SimDuration imu{}, estimate_imu{}, estimate_frame{};  ///< times of the newest
  bool pending = false, has_policy = false;
  SimDuration pending_since{}, plan_in_force{};

  auto relativeTo(SimDuration now) const {
    return std::make_tuple(now - imu, now - estimate_imu, now - estimate_frame, pending, has_policy,
                           pending ? now - pending_since : SimDuration{}, now - plan_in_force);
  }
};

bool isMultiple(SimDuration t, SimDuration period) { return t % period == SimDuration::zero(); }

/// As Plant and RobotController do it.
LoopEvent eventAt(SimDuration t, const LoopPeriods& p, Clockwork& c) {
  LoopEvent e;
  e.imu = isMultiple(t, p.imu);
  if (e.imu) c.imu = t;
  e.drives = isMultiple(t, p.drives);
  e.estimate = isMultiple(t, p.estimator);
  if (e.estimate) {
    c.estimate_imu = c.imu;
    c.estimate_frame = t;
  }
  e.track = isMultiple(t, p.tracker);
  const bool plans = isMultiple(t, p.planner);
  if (!e.estimate && !e.track && !plans) return e;  // no event of the controller
  e.activate = c.pending && t >= c.pending_since + p.plan_latency;
  if (e.activate) {
    c.plan_in_force = c.pending_since;
    c.pending = false;
  }
  e.plan = plans && !c.pending;
  if (e.plan) {
    e.at_once = p.plan_latency == SimDuration::zero() || !c.has_policy;
    if (e.at_once) {
      c.plan_in_force = t;
      c.has_policy = true;
    } else {
      c.pending = true;
      c.pending_since = t;
    }
  }
  e.imu_age = t - c.estimate_imu;
  e.frame_age = t - c.estimate_frame;
  e.plan_age = t - c.plan_in_force;
  return e;
}

}  // namespace

LoopPeriods loopPeriods(const RunConfig& config) {
  const Rates& rates = config.scenario.rates;
  const PlantConfig& plant = config.plant.plant;
  return {plant.drive_period, plant.sensors.imu.period, rates.estimator, rates.planner,
          rates.tracker,      rates.plan_latency};
}

LoopSchedule makeLoopSchedule(const LoopPeriods& p) {
  SimDuration common{1};
  for (const SimDuration period : {p.drives, p.imu, p.estimator, p.planner, p.tracker}) {
    common = SimDuration(std::lcm(common.count(), period.count()));
    if (common > kLongestPeriod) {
      throw InputError(fmt::format(
          "the periods of estimator ({}), planner ({}), tracker ({}), drives ({}) and IMU ({}) "
          "come "
          "together only after more than {}: choose some that do earlier for this analysis",
          toText(p.estimator), toText(p.planner), toText(p.tracker), toText(p.drives),
          toText(p.imu), toText(kLongestPeriod)));
    }
  }
  const auto next = [&](SimDuration t) {
    SimDuration soonest = SimDuration::max();
    for (const SimDuration period : {p.drives, p.imu, p.estimator, p.planner, p.tracker}) {
      soonest = std::min(soonest, (t / period + 1) * period);
    }
    return soonest;
  };
  // A long latency lets planner periods pass, so that it may take several common periods until
  // plans begin at the same places again.
  LoopSchedule out;
  Clockwork clockwork;
  std::vector<std::size_t> begins;
  std::vector<decltype(clockwork.relativeTo({}))> states;
  for (SimDuration t{}; static_cast<int>(begins.size()) < kPeriodsToSettle;) {
    if (isMultiple(t, common)) {
      const auto state = clockwork.relativeTo(t);
      const auto before = std::find(states.begin(), states.end(), state);
      if (before != states.end()) {
        const auto n = before - states.begin();
        out.period = (static_cast<std::int64_t>(states.size()) - n) * common;
        out.events.erase(out.events.begin(),
                         out.events.begin() + static_cast<std::ptrdiff_t>(begins[n]));
        return out;
      }
      states.push_back(state);
      begins.push_back(out.events.size());
    }
    LoopEvent event = eventAt(t, p, clockwork);
    event.until_next = next(t) - t;
    out.events.push_back(event);
    t += event.until_next;
  }
  throw InputError(
      fmt::format("plans with rates.plan_latency_us of {} do not begin at the same places again "
                  "within {} common periods of the rates",
                  toText(p.plan_latency), kPeriodsToSettle));
}

}  // namespace ballbot
