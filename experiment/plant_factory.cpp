#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiment/plant_link.hpp"
#include "fmi/coupled_plant.hpp"
#include "plant/plant_config.hpp"
#include "plant/simbody_library.hpp"

namespace ballbot {
namespace {

/// An FMU that takes steps of one size needs a run that has no others: a last one that is shorter
/// would end it without a result.
void requireEvenSteps(const Scenario& scenario, const FmuUse& fmu) {
  const Rates& r = scenario.rates;
  const SimDuration step = std::min({r.tracker, r.estimator, r.planner});
  const std::string why = fmt::format(
      "FMU '{}' takes steps of one size only (canHandleVariableCommunicationStepSize is false)",
      fmu.name);
  for (const SimDuration period : {r.tracker, r.estimator, r.planner}) {
    if (period % step == SimDuration::zero()) continue;
    throw InputError(
        fmt::format("rates: {}, but {} is no whole multiple of {}. Choose tracker, "
                    "estimator and planner periods that are multiples of the shortest",
                    why, toText(period), toText(step)));
  }
  if (scenario.duration % step == SimDuration::zero()) return;
  const SimDuration below = scenario.duration - scenario.duration % step;
  throw InputError(fmt::format("duration_s: {}, but {} is no whole multiple of {}. Nearest: {}, {}",
                               why, toText(scenario.duration), toText(step), toText(below),
                               toText(below + step)));
}

}  // namespace

std::unique_ptr<Participant> makePlant(const Scenario& scenario) {
  return makePlantWithFmus(scenario.tree);
}

void checkPlant(const Scenario& scenario) {
  requireSimbodyKind(loadedSimbodyKind());
  readPlantConfig(scenario.tree);
  if (!scenario.tree.find("fmus")) return;
  for (const FmuUse& fmu : planCoupling(scenario.tree).fmus) {
    if (!fmu.variable_steps) requireEvenSteps(scenario, fmu);
  }
}

}  // namespace ballbot
