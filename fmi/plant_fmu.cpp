#include "fmi/plant_fmu.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/state_visitors.hpp"
#include "core/yaml_file.hpp"
#include "fmi/plant_parameters.hpp"
#include "fmi/step_time.hpp"
#include "model/signal_table.hpp"
#include "plant/added_truth.hpp"
#include "plant/plant.hpp"

namespace ballbot {
namespace {

constexpr const char* kBlobKind = "plant FMU";
constexpr std::uint32_t kBlobVersion = 1;
/// Part of the token; grows when names, types or order of the variables change.
constexpr int kInterfaceVersion = 1;

std::string readFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be read; is this the FMU's resources folder?");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

ConfigNode loadResources(const std::string& folder, const std::string& token, int fmi_version) {
  const std::string file = folder + "/scenario.yaml";
  const std::string expected =
      fmuToken(readFile(file), readFile(folder + "/robot.urdf"), fmi_version);
  if (token != expected) {
    throw InputError(
        fmt::format("GUID or instantiation token is '{}', but the resources in '{}' belong to "
                    "'{}': model description and resources are not of one FMU",
                    token, folder, expected));
  }
  return loadYamlFile(file);
}

template <typename Frame>
Frame frameOf(const std::vector<Signal<Frame>>& signals, const double* from) {
  Frame frame;
  writeSignals(signals, from, frame);
  return frame;
}

constexpr int kForceValues = 9;

/// The words of a hash, as the 32-bit integers of FMI 2.
double half(std::uint64_t hash, int shift) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(hash >> shift));
}

}  // namespace

SimDuration readPlantSubstep(const ConfigNode& scenario) {
  return readPlantConfig(scenario).substep;
}

std::string fmuToken(const std::string& scenario_yaml, const std::string& urdf, int fmi_version) {
  Digest digest;
  digest.add(static_cast<std::int64_t>(kInterfaceVersion));
  digest.add(static_cast<std::int64_t>(fmi_version));
  digest.add(static_cast<std::int64_t>(scenario_yaml.size()));
  digest.add(scenario_yaml);
  digest.add(urdf);
  std::string hex = digest.hex();
  for (const std::size_t at : {8, 13, 18, 23}) hex.insert(at, "-");
  return "{" + hex + "}";
}

PlantFmu::PlantFmu(const std::string& resources, const std::string& token, int fmi_version)
    : token_(token),
      scenario_(loadResources(resources, token, fmi_version)),
      variables_(scenario_),
      values_(variables_.startValues()),
      held_(kForceValues, 0.0) {
  readPlantConfig(scenario_);  // whatever is wrong with it is said now
}

PlantFmu::~PlantFmu() = default;

void PlantFmu::demand(const char* words, LifecycleCall call) const {
  if (allows(mode_, call)) return;
  throw CallOrderError(toText(mode_), words,
                       fmt::format("{} is not allowed in state '{}'", words, toText(mode_)));
}

void PlantFmu::setTimes(double start_s, std::optional<double> stop_s) {
  demand("setting start and stop time", LifecycleCall::kEnterInitializationMode);
  const SimTime start = timeFromSeconds("start time", start_s);
  std::optional<SimTime> stop;
  if (stop_s) {
    stop = timeFromSeconds("stop time", *stop_s);
    if (*stop < start) {
      throw InputError(
          fmt::format("stop time is {} s, must not be before the start at {} s", *stop_s, start_s));
    }
  }
  start_ = now_ = start;
  stop_ = stop;
}

void PlantFmu::enterInitialization() {
  demand("entering initialization", LifecycleCall::kEnterInitializationMode);
  now_ = start_;
  stale_ = digest_stale_ = true;
  mode_ = LifecycleState::kInitialization;
}

void PlantFmu::exitInitialization() {
  demand("leaving initialization", LifecycleCall::kExitInitializationMode);
  plant();
  mode_ = LifecycleState::kStep;
}

void PlantFmu::terminate() {
  demand("terminate", LifecycleCall::kTerminate);
  mode_ = LifecycleState::kTerminated;
}

void PlantFmu::reset() {
  plant_.reset();
  values_ = variables_.startValues();
  held_.assign(kForceValues, 0.0);
  start_ = now_ = SimTime{};
  stop_.reset();
  stale_ = digest_stale_ = true;
  mode_ = LifecycleState::kInstantiated;
}

void PlantFmu::doStep(double communication_point_s, double step_s) {
  demand("doStep", LifecycleCall::kDoStep);
  const StepTarget target = stepTarget(now_, communication_point_s, step_s, stop_);
  if (!target.refusal.empty()) throw InputError("doStep: " + target.refusal);
  const FmuVariables::Groups& g = variables_.groups();
  held_.assign(&values_[g.forces], &values_[g.forces] + kForceValues);
  plant_->setExternalForces(frameOf(externalForceSignals(), held_.data()));
  stale_ = digest_stale_ = true;
  plant_->advanceTo(target.end, frameOf(commandSignals(), &values_[g.command]));
  now_ = target.end;
}

double PlantFmu::value(ValueReference reference) {
  const FmuVariable* v = variables_.find(reference);
  if (!v) throw InputError(fmt::format("there is no variable with value reference {}", reference));
  if (v->role == VariableRole::kTime) return secondsOf(now_);
  // Before initialisation outputs show their start values, which are zero.
  if (!v->hasStart() && mode_ != LifecycleState::kInstantiated) {
    if (stale_) refresh();
    const ValueReference digest = variables_.groups().digest;
    if (digest_stale_ && v->reference == digest) {
      const std::uint64_t hash = plant().stateDigest();
      values_[digest] = half(hash, 0);
      values_[digest + 1] = half(hash, 32);
      digest_stale_ = false;
    }
  }
  return values_[reference];
}

void PlantFmu::setValue(ValueReference reference, double value) {
  const FmuVariable* v = variables_.find(reference);
  if (!v) throw InputError(fmt::format("there is no variable with value reference {}", reference));
  const bool before_start =
      mode_ == LifecycleState::kInstantiated || mode_ == LifecycleState::kInitialization;
  const std::string name = elementName(*v, static_cast<int>(reference - v->reference));
  if (!v->hasStart()) {
    throw InputError(fmt::format("'{}' cannot be set: it is no input and no parameter", name));
  }
  if (isParameter(reference) && !before_start) {
    throw InputError(
        fmt::format("parameter '{}' cannot be set in state '{}', only before "
                    "initialization ends",
                    name, toText(mode_)));
  }
  if (!before_start) demand("setting inputs", LifecycleCall::kDoStep);
  if (!std::isfinite(value)) {
    throw InputError(fmt::format("'{}' is set to {}, must be finite", name, value));
  }
  if (isParameter(reference) && value != values_[reference]) {
    ConfigNode scratch = ConfigNode::map({});
    setParameter(plantParameters()[reference - variables_.groups().parameters], value, scratch);
    plant_.reset();  // to be built anew
    stale_ = digest_stale_ = true;
  }
  values_[reference] = value;
}

ConfigNode PlantFmu::effectiveScenario(const std::vector<double>& values) const {
  ConfigNode scenario = scenario_;
  const ValueReference first = variables_.groups().parameters;
  const std::vector<PlantParameter>& parameters = plantParameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = values[first + i];
    if (value != variables_.find(first + static_cast<ValueReference>(i))->start) {
      setParameter(parameters[i], value, scenario);
    }
  }
  return scenario;
}

std::unique_ptr<Plant> PlantFmu::makePlant(const std::vector<double>& values) const {
  return std::make_unique<Plant>(readPlantConfig(effectiveScenario(values)));
}

void PlantFmu::take(std::unique_ptr<Plant> plant) {
  plant_ = std::move(plant);
  truth_places_ = AddedTruth::placesOf(plant_->added(AddedTo::kTruth));
}

Plant& PlantFmu::plant() {
  if (!plant_) {
    take(makePlant(values_));
    plant_->reset(start_);
  }
  return *plant_;
}

void PlantFmu::refresh() {
  const FmuVariables::Groups& g = variables_.groups();
  readSignals(sensorSignals(), plant().sensors(), &values_[g.sensors]);
  const std::vector<double>& sensors = plant().added(AddedTo::kSensors).values;
  std::copy(sensors.begin(), sensors.end(), values_.begin() + g.added_sensors);
  readSignals(truthSignals(), plant().truth(), &values_[g.truth]);
  const AddedSignals& added = plant().added(AddedTo::kTruth);  // others stay 0
  for (std::size_t i = 0; i < added.values.size(); ++i) {
    values_[g.added_truth + truth_places_[i]] = added.values[i];
  }
  stale_ = false;
}

struct PlantFmu::State {
  std::string token;
  LifecycleState mode;
  SimTime start, now;
  bool has_stop;
  SimTime stop;
  std::vector<double> settable, held;
  bool has_plant;
  StateBlob plant;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit.form(self.token, [](const std::string&) {
      return "this state is of an FMU made from another scenario, robot or FMI version";
    });
    visit(self.mode);
    visit(self.start);
    visit(self.now);
    visit(self.has_stop);
    visit(self.stop);
    visit(self.settable);
    visit(self.held);
    visit(self.has_plant);
    if (self.has_plant) visit(self.plant);
  }
};

PlantFmu::State PlantFmu::stateWithoutPlant() const {
  std::vector<double> settable;
  for (const FmuVariable& v : variables_.all()) {
    if (!v.hasStart()) continue;
    settable.insert(settable.end(), &values_[v.reference], &values_[v.reference] + v.size);
  }
  return {token_,
          mode_,
          start_,
          now_,
          stop_.has_value(),
          stop_.value_or(SimTime{}),
          std::move(settable),
          held_,
          false,
          {}};
}

StateBlob PlantFmu::saveState() const {
  State s = stateWithoutPlant();
  s.has_plant = plant_ != nullptr;
  if (plant_) s.plant = plant_->saveState();
  return saveStateOf(s, kBlobKind, kBlobVersion);
}

PlantFmu::State PlantFmu::read(const StateBlob& blob) const {
  State s = stateWithoutPlant();
  restoreStateOf(s, blob, kBlobKind, kBlobVersion);
  if (s.mode > LifecycleState::kFailed) {
    throw InputError("this state does not have the form of this FMU's");
  }
  return s;
}

void PlantFmu::checkState(const StateBlob& blob) const { read(blob); }

void PlantFmu::restoreState(const StateBlob& blob) {
  State s = read(blob);
  std::vector<double> values = variables_.startValues();
  auto next = s.settable.begin();
  for (const FmuVariable& v : variables_.all()) {
    if (!v.hasStart()) continue;
    std::copy_n(next, v.size, &values[v.reference]);
    next += v.size;
  }
  const auto first = static_cast<std::ptrdiff_t>(variables_.groups().parameters);
  if (s.has_plant) {
    // A plant with the same parameters is worth keeping: to build one costs many restores.
    const bool fits =
        plant_ && std::equal(values_.begin() + first, values_.end(), values.begin() + first);
    std::unique_ptr<Plant> fresh = fits ? nullptr : makePlant(values);
    Plant& target = fits ? *plant_ : *fresh;
    target.setExternalForces(frameOf(externalForceSignals(), s.held.data()));
    target.restoreState(s.plant);
    if (fresh) take(std::move(fresh));
  } else {
    plant_.reset();
  }
  values_ = std::move(values);
  held_ = std::move(s.held);
  mode_ = s.mode;
  start_ = s.start;
  now_ = s.now;
  stop_ = s.has_stop ? std::optional<SimTime>(s.stop) : std::nullopt;
  stale_ = digest_stale_ = true;
}

}  // namespace ballbot
