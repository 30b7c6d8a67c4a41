#pragma once

#include <memory>
#include <string>
#include <vector>

#include "controller/controller_settings.hpp"
#include "estimator/estimator_registry.hpp"
#include "experiment/recording.hpp"
#include "experiment/scenario.hpp"
#include "fmi/coupling_plan.hpp"
#include "metrics/home_frame.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {

/// The plant of a scenario, read: this program's own, and FMUs coupled to it or in its place.
struct PlantSetup {
  PlantConfig plant;
  std::shared_ptr<const CouplingPlan> coupling;  ///< none without FMUs
};

/// A scenario, read once: what a run is made of, in types. Who builds, steps, judges or draws a
/// part of a run takes it from here and reads no file.
struct RunConfig {
  Scenario scenario;      ///< name, times, rates, requirements; and the tree, to be written again
  RobotParameters robot;  ///< empty-handed; what it carries is the plant's, or believed
  PlantSetup plant;
  std::shared_ptr<const EstimatorSettings> estimator;
  ControllerSettings controller;
  Recording recording;
  /// Where references and estimates are meant: W if the estimator is told the pose from outside,
  /// else where the robot is put down.
  HomeFrame home;

  const RobotParameters& believedRobot() const { return controller.believed_robot; }
  std::shared_ptr<const MotionReference> reference() const { return controller.law->reference(); }
};

/// @throw InputError with file, line and column, for whatever is wrong with any part, or between
/// parts.
RunConfig readRunConfig(Scenario scenario);

/// The plant's part alone, for its own process. @throw InputError
PlantSetup readPlantSetup(const Scenario& scenario);

}  // namespace ballbot
