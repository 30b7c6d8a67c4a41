#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config_node.hpp"
#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "cosim/lifecycle_state.hpp"
#include "fmi/variables.hpp"

namespace ballbot {

class Plant;

/// The plant behind the C interfaces of FMI 2 and FMI 3: variables by reference, time as importers
/// reckon it, whole state as one blob. What the two versions do differently is in fmi2_plant.cpp
/// and fmi3_plant.cpp.
///
/// All calls throw Error in words; a call that throws has changed nothing but, for doStep, perhaps
/// the plant. Nothing is shared between instances.
class PlantFmu {
 public:
  /// @param resources folder with scenario.yaml and robot.urdf
  /// @param token what the model description says; must fit the resources
  /// @param fmi_version 2 or 3
  PlantFmu(const std::string& resources, const std::string& token, int fmi_version);
  ~PlantFmu();

  LifecycleState mode() const { return mode_; }
  SimTime now() const { return now_; }
  const FmuVariables& variables() const { return variables_; }

  // The life cycle. @throw CallOrderError in a mode that does not allow the call.
  void setTimes(double start_s, std::optional<double> stop_s);
  void enterInitialization();
  void exitInitialization();
  void doStep(double communication_point_s, double step_s);
  void terminate();
  void reset();
  void fail() { mode_ = LifecycleState::kFailed; }

  /// Value of one element; integers, booleans and enumerations as doubles. In initialisation this
  /// builds the plant, if it is an output or a local that is asked for.
  double value(ValueReference reference);
  /// @throw InputError if the variable cannot be set, or not now, or not to this.
  void setValue(ValueReference reference, double value);

  /// Everything, mode and parameters included: restoring it into any instance of the same FMU, in
  /// any mode and process, continues bit for bit.
  StateBlob saveState() const;
  /// @throw InputError if these bytes are no such state; nothing has changed then.
  void restoreState(const StateBlob& blob);
  /// Whether restoreState could read it. @throw InputError if not.
  void checkState(const StateBlob& blob) const;

 private:
  /// What is saved.
  struct State;
  State stateWithoutPlant() const;
  /// @throw InputError if these bytes are not such a state of this FMU.
  State read(const StateBlob& blob) const;
  void demand(const char* words, LifecycleCall call) const;
  /// The scenario with the parameters as they are now.
  ConfigNode effectiveScenario(const std::vector<double>& values) const;
  std::unique_ptr<Plant> makePlant(const std::vector<double>& values) const;
  Plant& plant();
  void take(std::unique_ptr<Plant> plant);
  void refresh();
  bool isParameter(ValueReference reference) const {
    return reference >= variables_.groups().parameters;
  }

  std::string token_;
  ConfigNode scenario_;
  FmuVariables variables_;
  LifecycleState mode_ = LifecycleState::kInstantiated;
  SimTime start_{}, now_{};
  std::optional<SimTime> stop_;
  std::vector<double> values_;  ///< of all elements; those of the plant as of the last refresh()
  std::vector<double> held_;    ///< external forces during the last step
  std::unique_ptr<Plant> plant_;
  std::vector<std::size_t> truth_places_;  ///< of its added truth behind the group's start
  bool stale_ = true;         ///< values_ of outputs and locals are older than the plant
  bool digest_stale_ = true;  ///< the same for the digest, which costs more
};

/// Longest integration step of the plant a scenario describes. @throw InputError
SimDuration readPlantSubstep(const ConfigNode& scenario);

/// What ties a model description to the scenario, URDF and interface it was made for; the bytes of
/// the two files in `resources` go into it. In the form of a GUID.
std::string fmuToken(const std::string& scenario_yaml, const std::string& urdf, int fmi_version);

}  // namespace ballbot
