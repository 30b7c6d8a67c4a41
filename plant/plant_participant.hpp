#pragma once

#include <memory>
#include <string>

#include "cosim/participant.hpp"
#include "plant/plant.hpp"

namespace ballbot {

/// The plant as a participant of a co-simulation.
class PlantParticipant final : public Participant {
 public:
  explicit PlantParticipant(const PlantConfig& config) : plant_(config) {}

  std::string name() const override { return "plant"; }
  void enterInitializationMode(SimTime start) override { plant_.reset(start); }
  void exitInitializationMode() override {}
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  /// As Plant::setExternalForces.
  void setExternalForces(const ExternalForces& forces) { plant_.setExternalForces(forces); }
  void terminate() override {}
  void reset() override { plant_.reset(kSimStart); }
  const SensorFrame& sensors() const override { return plant_.sensors(); }
  std::optional<TruthFrame> truth() const override { return plant_.truth(); }
  StateBlob saveState() const override { return plant_.saveState(); }
  void restoreState(const StateBlob& blob) override { plant_.restoreState(blob); }
  std::uint64_t stateDigest() const override { return plant_.stateDigest(); }

 private:
  Plant plant_;
};

/// The plant that a scenario describes. @throw InputError with file, line and column.
std::unique_ptr<Participant> makePlantParticipant(const ConfigNode& scenario);

}  // namespace ballbot
