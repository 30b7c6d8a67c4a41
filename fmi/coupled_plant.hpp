#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cosim/participant.hpp"
#include "fmi/coupling_plan.hpp"
#include "fmi/native_plant_model.hpp"
#include "fmi/stepped_model.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {

/// The plant of a scenario that has `fmus:`: this program's own, or an FMU in its place, together
/// with other FMUs that are coupled to it. Values are exchanged at the events of the run and held
/// in between; all take their steps in the order of the scenario.
///
/// All calls throw what the models throw: LostParticipantError names an FMU whose process ended.
class CoupledPlant final : public Participant {
 public:
  /// @param plant  of the same scenario; unused where an FMU stands in the plant's place
  /// @param program executable of this program, for the FMUs' processes
  CoupledPlant(CouplingPlan plan, const PlantConfig& plant,
               const std::string& program = "/proc/self/exe");

  std::string name() const override { return kPlantName; }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override {}
  /// @throw InputError also if a command that no connection takes is not zero.
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  void terminate() override;
  void reset() override;
  const SensorFrame& sensors() const override { return sensors_; }
  std::optional<TruthFrame> truth() const override;
  const AddedSignals& added(AddedTo frame) const override;
  StateBlob saveState() const override;
  /// If one of the FMUs refuses its part, those before it have changed: reset or restore again.
  void restoreState(const StateBlob& blob) override;
  std::uint64_t stateDigest() const override;

 private:
  using Rows = std::vector<std::vector<double>>;
  /// What is saved.
  struct State;

  void evaluate(const std::vector<std::size_t>& nodes);
  void requireTaken() const;
  void observe();

  CouplingPlan plan_;
  std::size_t controller_, record_;
  /// One per node of the graph but controller and record, which come last and have none.
  std::vector<std::unique_ptr<SteppedModel>> models_;
  const NativePlantModel* native_ = nullptr;  ///< of the models, where it is one
  AddedSignals added_truth_;
  std::vector<std::size_t> added_truth_places_;  ///< behind the frame's own values
  Rows inputs_, outputs_;
  Rows before_;  ///< outputs one communication step ago, for delayed connections
  SimTime now_{};
  SensorFrame sensors_;
  TruthFrame truth_;
};

}  // namespace ballbot
