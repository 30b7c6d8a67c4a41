#pragma once

#include <array>
#include <string>
#include <vector>

#include "cosim/log_reader.hpp"
#include "metrics/home_frame.hpp"
#include "model/motion_reference.hpp"
#include "model/robot_parameters.hpp"
#include "plant/environment.hpp"
#include "report/report_data.hpp"

namespace ballbot {

struct RunConfig;

/// What the robot's URDF, which is drawn, calls what moves.
struct ReplayNames {
  std::string base, ball;
  std::array<std::string, kJointCount> joints;  ///< in the order of the actuators

  /// @throw InputError for a URDF that cannot be read any more
  static ReplayNames of(const RunConfig& config);
};

/// The 3-D replay of a run from its recorded truth: base, ball, joints, the end-effector's frame
/// and what was asked of it, pushes where they act, contact. Nothing if no truth was recorded.
/// `pushes` are the scheduled ones, for where they act.
/// @param home  frame in which the reference is meant
ReportReplay makeReplay(const RunLog& log, const RobotParameters& robot, const ReplayNames& names,
                        const std::vector<Push>& pushes, const MotionReference& reference,
                        const HomeFrame& home);

}  // namespace ballbot
