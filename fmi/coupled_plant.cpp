#include "fmi/coupled_plant.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/state_visitors.hpp"
#include "fmi/native_plant_model.hpp"
#include "model/signal_table.hpp"
#include "plant/added_truth.hpp"

namespace ballbot {
namespace {

constexpr const char* kBlobKind = "coupled plant";
constexpr std::uint32_t kBlobVersion = 1;

}  // namespace

CoupledPlant::CoupledPlant(CouplingPlan plan, const PlantConfig& plant, const std::string& program)
    : plan_(std::move(plan)),
      controller_(plan_.graph.find(kControllerName)),
      record_(plan_.graph.find(kRecordName)) {
  if (plan_.native_plant) {
    auto native = std::make_unique<NativePlantModel>(plant);
    native_ = native.get();
    models_.push_back(std::move(native));
  }
  for (const FmuUse& use : plan_.fmus)
    models_.push_back(std::make_unique<FmuProcess>(use, program));
  for (const CouplingNode& node : plan_.graph.nodes()) {
    inputs_.emplace_back(node.inputSize(), 0.0);
    outputs_.emplace_back(node.outputSize(), 0.0);
  }
  for (std::size_t i = 0; i < models_.size(); ++i) outputs_[i] = models_[i]->outputs();
  before_ = outputs_;
  const AddedSignals truth = AddedTruth(plant).signals();
  if (!plan_.feeds(truth)) return;
  added_truth_ = truth;
  added_truth_places_ = AddedTruth::placesOf(truth);
}

void CoupledPlant::enterInitializationMode(SimTime start) {
  now_ = start;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    models_[i]->initialize(start);
    outputs_[i] = models_[i]->outputs();
  }
  before_ = outputs_;
  evaluate(plan_.graph.beforeController());
  observe();
}

void CoupledPlant::doStep(SimTime now, SimDuration step, const ActuatorCommand& command) {
  readSignals(commandSignals(), command, outputs_[controller_].data());
  requireTaken();
  evaluate(plan_.graph.afterController());
  for (std::size_t i = 0; i < models_.size(); ++i) {
    plan_.graph.gather(i, outputs_, before_, inputs_[i]);
  }
  before_ = outputs_;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    models_[i]->doStep(now, step, inputs_[i]);
    outputs_[i] = models_[i]->outputs();
  }
  now_ = now + step;
  evaluate(plan_.graph.beforeController());
  observe();
}

void CoupledPlant::evaluate(const std::vector<std::size_t>& nodes) {
  for (const std::size_t i : nodes) {
    plan_.graph.gather(i, outputs_, before_, inputs_[i]);
    models_[i]->evaluate(inputs_[i]);
    outputs_[i] = models_[i]->outputs();
  }
}

void CoupledPlant::requireTaken() const {
  for (const CouplingPort& port : plan_.graph.nodes()[controller_].outputs) {
    if (plan_.graph.used(controller_, port)) continue;
    for (std::size_t i = 0; i < port.size; ++i) {
      if (outputs_[controller_][port.offset + i] == 0) continue;
      throw InputError(fmt::format("at {}: the controller sets '{}', but no connection takes it",
                                   toText(now_), port.name));
    }
  }
}

void CoupledPlant::observe() {
  plan_.graph.gather(controller_, outputs_, before_, inputs_[controller_]);
  writeSignals(sensorSignals(), inputs_[controller_].data(), sensors_);
  sensors_.time = now_;
  if (!plan_.has_truth) return;
  plan_.graph.gather(record_, outputs_, before_, inputs_[record_]);
  writeSignals(truthSignals(), inputs_[record_].data(), truth_);
  truth_.time = now_;
  const double* added = inputs_[record_].data() + rowSize(truthSignals());
  for (std::size_t i = 0; i < added_truth_places_.size(); ++i) {
    added_truth_.values[i] = added[added_truth_places_[i]];
  }
}

void CoupledPlant::terminate() {
  for (const auto& model : models_) model->terminate();
}

void CoupledPlant::reset() {
  for (const auto& model : models_) model->reset();
}

std::optional<TruthFrame> CoupledPlant::truth() const {
  return plan_.has_truth ? std::optional<TruthFrame>(truth_) : std::nullopt;
}

const AddedSignals& CoupledPlant::added(AddedTo frame) const {
  if (frame == AddedTo::kTruth) return added_truth_;
  return native_ == nullptr ? AddedSignals::none() : native_->added(frame);
}

struct CoupledPlant::State {
  Rows outputs, before;
  SimTime now;
  std::vector<StateBlob> models;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.outputs);
    visit(self.before);
    visit(self.now);
    visit(self.models);
  }
};

StateBlob CoupledPlant::saveState() const {
  State state{outputs_, before_, now_, {}};
  for (const auto& model : models_) state.models.push_back(model->saveState());
  return saveStateOf(state, kBlobKind, kBlobVersion);
}

void CoupledPlant::restoreState(const StateBlob& blob) {
  State next{outputs_, before_, now_, std::vector<StateBlob>(models_.size())};
  restoreStateOf(next, blob, kBlobKind, kBlobVersion);
  for (std::size_t i = 0; i < models_.size(); ++i) models_[i]->restoreState(next.models[i]);
  now_ = next.now;
  outputs_ = std::move(next.outputs);
  before_ = std::move(next.before);
  observe();
}

std::uint64_t CoupledPlant::stateDigest() const {
  if (models_.size() == 1) return models_.front()->stateDigest();
  std::vector<std::uint64_t> digests;
  for (const auto& model : models_) digests.push_back(model->stateDigest());
  return hash64(digests.data(), digests.size() * sizeof(std::uint64_t));
}

}  // namespace ballbot
