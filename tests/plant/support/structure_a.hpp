#pragma once

#include <memory>

#include "plant/multibody.hpp"

namespace ballbot {

/// The robot put together another way, from Simbody's own parts: a free ball with its true mass and
/// inertia that SphereOnPlaneContact lets roll on the floor, its spin about the vertical held, the
/// base as a child of the ball, wheels that NoSlip1D ties to it. It shares no equation of rolling
/// with the plant. Ideal actuators only.
class StructureA {
 public:
  explicit StructureA(const RobotParameters& robot);
  ~StructureA();

  struct Acceleration {
    Vector3 a_WK_W, alpha_WB_W;
    JointVector joints;
  };
  Acceleration acceleration(const RobotPose& pose, const VelocityVector& nu,
                            const MultibodyLoads& loads);
  /// Largest constraint error of that state on velocity level [m/s, rad/s].
  double velocityError() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
