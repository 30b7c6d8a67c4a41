#pragma once

#include <vector>

#include "fmi/coupling_config.hpp"
#include "fmi/stepped_model.hpp"
#include "plant/plant.hpp"

namespace ballbot {

/// This program's own plant as a model in a coupling. Inputs: command, external forces; outputs:
/// sensors, truth; each in the order of model/signal_table.hpp.
class NativePlantModel final : public SteppedModel {
 public:
  explicit NativePlantModel(const PlantConfig& config);

  std::string name() const override { return kPlantName; }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override {}
  /// No output of the plant follows from an input at once.
  void evaluate(const std::vector<double>&) override {}
  void doStep(SimTime now, SimDuration step, const std::vector<double>& inputs) override;
  void terminate() override {}
  void reset() override { plant_.reset(kSimStart); }
  StateBlob saveState() const override { return plant_.saveState(); }
  void restoreState(const StateBlob& blob) override;
  const std::vector<double>& outputs() const override { return outputs_; }
  const AddedSignals& added(AddedTo frame) const { return plant_.added(frame); }
  std::uint64_t stateDigest() const override { return plant_.stateDigest(); }

 private:
  void observe();

  Plant plant_;
  std::vector<double> outputs_;
  std::vector<std::size_t> added_truth_places_;
};

}  // namespace ballbot
