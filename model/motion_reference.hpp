#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// Where ball and end-effector should be at one instant, and which components are asked for.
struct PlaceReference {
  Eigen::Vector2d ball = Eigen::Vector2d::Zero();  ///< in W [m]
  Vector3 ee = Vector3::Zero();                    ///< p_WE [m]
  Eigen::Array2d ball_asked =
      Eigen::Array2d::Zero();  ///< 1 for a component that has a weight, else 0
  Eigen::Array3d ee_asked = Eigen::Array3d::Zero();
};

/// Components of the end-effector's pose: position [m], then yaw, pitch, roll of E [rad].
constexpr int kPoseDim = 6;
using PoseVector = Eigen::Matrix<double, kPoseDim, 1>;

/// A step of the reference: at one time, by so much in each component.
struct EeStep {
  SimTime at;
  PoseVector by = PoseVector::Zero();
};

/// What a controller asks of the robot's motion over time, for those who judge and draw a run. This
/// one asks for nothing.
class MotionReference {
 public:
  virtual ~MotionReference() = default;

  virtual PlaceReference place(SimTime) const { return {}; }
  virtual PoseVector eePose(SimTime) const { return PoseVector::Zero(); }
  /// Whether the end-effector is ever asked to go anywhere.
  virtual bool eeMoves() const { return false; }
  /// What is asked of the end-effector at once; ramps and circles are no steps.
  virtual std::vector<EeStep> eeSteps() const { return {}; }
};

}  // namespace ballbot
