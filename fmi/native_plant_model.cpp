#include "fmi/native_plant_model.hpp"

#include <algorithm>

#include "model/signal_table.hpp"
#include "plant/floor_truth.hpp"

namespace ballbot {

NativePlantModel::NativePlantModel(const PlantConfig& config)
    : plant_(config),
      outputs_(rowSize(sensorSignals()) + rowSize(truthSignals()) + FloorTruth::list().size(),
               0.0) {
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
  const std::vector<double>& floor = plant_.added(AddedTo::kTruth).values;
  std::copy(floor.begin(), floor.end(), truth + rowSize(truthSignals()));
}

}  // namespace ballbot
