#include "plant/plant_participant.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

void PlantParticipant::doStep(SimTime now, SimDuration step, const ActuatorCommand& command) {
  if (now != plant_.now()) {
    throw InputError(fmt::format("plant: asked to step from {}, but it stands at {}", toText(now),
                                 toText(plant_.now())));
  }
  plant_.advanceTo(now + step, command);
}

}  // namespace ballbot
