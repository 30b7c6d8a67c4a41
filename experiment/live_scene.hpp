#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "experiment/ee_reference.hpp"
#include "experiment/scenario.hpp"
#include "model/truth.hpp"
#include "plant/environment.hpp"
#include "plant/surroundings.hpp"

namespace ballbot {

/// What the live page shows of a run: a description once, then one frame per true state, both as
/// JSON. The scenario must be that of the run.
class LiveScene {
 public:
  /// @throw InputError as the parts of the scenario.
  explicit LiveScene(const Scenario& scenario);

  /// Title, robot, names of all that moves, and of the plots' lines.
  std::string description() const;
  /// Poses, joint angles, forces, and the plots' values at one time.
  std::string frame(const TruthFrame& truth);

 private:
  Scenario scenario_;
  RobotParameters robot_;
  EeReference reference_;
  std::vector<Push> pushes_;
  SurroundingsParameters surroundings_;
  bool started_ = false;
  double last_s_ = 0;
  Eigen::Quaterniond ball_ = Eigen::Quaterniond::Identity();  ///< from rolling, frame to frame
};

}  // namespace ballbot
