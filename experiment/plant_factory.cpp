#include "experiment/plant_link.hpp"
#include "fmi/coupled_plant.hpp"
#include "plant/plant_config.hpp"
#include "plant/simbody_library.hpp"

namespace ballbot {

std::unique_ptr<Participant> makePlant(const Scenario& scenario) {
  return makePlantWithFmus(scenario.tree);
}

void checkPlant(const Scenario& scenario) {
  requireSimbodyKind(loadedSimbodyKind());
  readPlantConfig(scenario.tree);
  if (scenario.tree.find("fmus")) planCoupling(scenario.tree);
}

}  // namespace ballbot
