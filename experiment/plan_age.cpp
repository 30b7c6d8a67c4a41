#include "experiment/plan_age.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "experiment/motion_metrics.hpp"

namespace ballbot {

void requireYoungPlans(const Scenario& scenario) {
  const auto mpc = readMpc(scenario);
  if (!mpc) return;
  // A plan is begun when the one before has begun to act, at the next of the planner's times.
  const SimDuration period = scenario.rates.planner, latency = scenario.rates.plan_latency;
  const std::int64_t periods = std::max<std::int64_t>(1, (latency + period - SimDuration(1)) / period);
  const SimDuration oldest = periods * period + latency;
  if (oldest <= mpc->fallback_after) return;
  const auto ms = [](SimDuration d) { return 1e3 * toSeconds(d); };
  ConfigReader controller(scenario.section("controller"), "controller");
  throw InputError(fmt::format(
      "{} is {:g}, must be at least {:g}: so old is a plan when the next one takes over, with {:g} ms "
      "from plan to plan (rates.planner_period_us) and {:g} ms until one acts (rates.plan_latency_us). "
      "Until then the LQR would stand in",
      controller.child("mpc").at("fallback_after_ms"), ms(mpc->fallback_after), ms(oldest),
      ms(periods * period), ms(latency)));
}

}  // namespace ballbot
