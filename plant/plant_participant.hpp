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
  const AddedSignals& added(AddedTo frame) const override { return plant_.added(frame); }
  StateBlob saveState() const override { return plant_.saveState(); }
  void restoreState(const StateBlob& blob) override { plant_.restoreState(blob); }
  std::uint64_t stateDigest() const override { return plant_.stateDigest(); }

 private:
  Plant plant_;
};

}  // namespace ballbot
