#include "experiment/plant_factory.hpp"

#include "fmi/coupled_plant.hpp"
#include "plant/plant_participant.hpp"

namespace ballbot {

std::unique_ptr<Participant> makePlant(const PlantSetup& setup) {
  if (!setup.coupling) return std::make_unique<PlantParticipant>(setup.plant);
  return std::make_unique<CoupledPlant>(*setup.coupling, setup.plant);
}

}  // namespace ballbot
