#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "experiment/run_config.hpp"
#include "experiment/run_replay.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// What the live page shows of a run: a description once, then one frame per true state, both as
/// JSON. The scenario must be that of the run.
class LiveScene {
 public:
  explicit LiveScene(const RunConfig& config);

  /// Title, robot, names of all that moves, and of the plots' lines.
  std::string description() const;
  /// Poses, joint angles, forces, and the plots' values at one time.
  std::string frame(const TruthFrame& truth);

 private:
  RunConfig config_;
  ReplayNames names_;
  bool started_ = false;
  double last_s_ = 0;
  Eigen::Quaterniond ball_ = Eigen::Quaterniond::Identity();  ///< from rolling, frame to frame
};

}  // namespace ballbot
