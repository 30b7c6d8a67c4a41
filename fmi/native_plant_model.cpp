#include "fmi/native_plant_model.hpp"

#include <algorithm>

#include "model/signal_table.hpp"
#include "plant/added_truth.hpp"

namespace ballbot {

NativePlantModel::NativePlantModel(const PlantConfig& config)
    : plant_(config),
      outputs_(rowSize(sensorSignals()) + rowSize(truthSignals()) + AddedTruth::list().size(), 0.0),
      added_truth_places_(AddedTruth::placesOf(plant_.added(AddedTo::kTruth))) {
  observe();
}

void NativePlantModel::enterInitializationMode(SimTime start) {
  plant_.reset(start);
  observe();
}

void NativePlantModel::doStep(SimTime now, SimDuration step, const std::vector<double>& inputs) {
  ActuatorCommand command;
  ExternalForces forces;
  writeSignals(commandSignals(), inputs.data(), command);
  writeSignals(externalForceSignals(), inputs.data() + rowSize(commandSignals()), forces);
  plant_.setExternalForces(forces);
  plant_.advanceTo(now + step, command);
  observe();
}

void NativePlantModel::restoreState(const StateBlob& blob) {
  plant_.restoreState(blob);
  observe();
}

void NativePlantModel::observe() {
  readSignals(sensorSignals(), plant_.sensors(), outputs_.data());
  double* truth = outputs_.data() + rowSize(sensorSignals());
  readSignals(truthSignals(), plant_.truth(), truth);
  const std::vector<double>& added = plant_.added(AddedTo::kTruth).values;
  for (std::size_t i = 0; i < added.size(); ++i) {
    truth[rowSize(truthSignals()) + added_truth_places_[i]] = added[i];
  }
}

}  // namespace ballbot
