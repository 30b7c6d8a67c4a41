#include "experiment/plant_link.hpp"
#include "plant/plant_config.hpp"
#include "plant/plant_participant.hpp"

namespace ballbot {

std::unique_ptr<Participant> makePlant(const Scenario& scenario) {
  return makePlantParticipant(scenario.tree);
}

void checkPlant(const Scenario& scenario) { readPlantConfig(scenario.tree); }

}  // namespace ballbot
