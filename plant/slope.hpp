#pragma once

#include <array>

#include "model/robot_parameters.hpp"
#include "plant/multibody.hpp"

namespace ballbot {

class ConfigVisitor;

/// A floor that is not level. W stays the floor's: z is its normal, and gravity is what leans.
struct Slope {
  double angle = 0;    ///< [rad]
  double heading = 0;  ///< in which it falls, from x of W [rad]

  void describe(ConfigVisitor& v);
  /// In W, for a gravity of that size [m/s^2].
  Vector3 gravityInWorld(double gravity) const;
};

/// What a slope changes of the weights of a robot's bodies, as forces on them. Wheels and rotors
/// count with the body that carries them, on whose axes they lie.
class SlopeForces {
 public:
  SlopeForces(const RobotParameters& robot, const Slope& slope);

  bool acts() const { return acts_; }
  /// Appended, one for each body.
  void addTo(std::vector<PointForce>& forces) const;
  /// Potential of these forces at the bodies' realized poses, zero at W's origin [J].
  double energy(const Multibody& multibody) const;

 private:
  bool acts_;
  std::array<PointForce, kBodyCount> forces_;
};

}  // namespace ballbot
