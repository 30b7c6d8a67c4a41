#pragma once

#include <memory>
#include <vector>

#include "plant/integrator.hpp"
#include "plant/multibody.hpp"
#include "plant/plant_config.hpp"
#include "plant/series_elastic_actuator.hpp"
#include "plant/slope.hpp"
#include "plant/surroundings.hpp"

namespace ballbot {

/// The plant between two events as one ordinary differential equation:
///
///   y = (multibody | surroundings | integral of specific force, integral of angular velocity since
///        the last IMU sample, both of the IMU in B)
///
/// What is constant between events (torque demands, pushes, whether the stand holds) is set before.
/// The time of derivative() is the one since the last drive tick [s].
class PlantDynamics final : public OdeSystem {
 public:
  explicit PlantDynamics(const PlantConfig& config);

  int dim() const { return multibody_->stateDim() + surroundings_.stateDim() + 6; }
  Multibody& multibody() { return *multibody_; }

  void derivative(double since_tick, const double* y, double* ydot) override;
  /// Robot and surroundings at rest.
  void place(const RobotPose& pose, double* y) const;
  /// Back onto the constraints.
  void project(double* y) const { multibody_->project(y); }
  /// Takes y as the current state and lets contacts slip that friction does not hold.
  void settle(double* y);

  void hold(bool held) { held_ = held; }
  std::vector<PointForce>& forces() { return loads_.forces; }

  /// The actuators' state between two drive ticks.
  struct Actuators {
    std::vector<SeriesElasticActuator> units;
    void reset() {
      for (SeriesElasticActuator& unit : units) unit.reset();
    }
    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.units);
    }
  };
  Actuators& actuators() { return actuators_; }
  const Actuators& actuators() const { return actuators_; }
  /// New torque demands at a drive tick, `since_last` [s] after the one before.
  void demand(const JointVector& motor_torque, double since_last);

  /// The surroundings at the realized state, which is that of y.
  Touch touch(const double* y) const;
  DoorMotion door(const double* y) const { return surroundings_.door(surroundingsState(y)); }
  /// Where the ball may spin, at the realized state.
  BallOnFloor ballOnFloor() const;
  /// Of robot, door, and the springs of contacts [J].
  double energy(const double* y) const;

  /// Torque on the joints at the realized state [N m].
  JointVector jointTorque(double since_tick);

  /// Integrals since they were last cleared, at the end of y.
  static Eigen::Map<Vector3> forceIntegral(double* y, int dim) {
    return Eigen::Map<Vector3>(y + dim - 6);
  }
  static Eigen::Map<Vector3> rateIntegral(double* y, int dim) {
    return Eigen::Map<Vector3>(y + dim - 3);
  }
  /// Specific force at the IMU, in B, for a base that moves so [m/s^2].
  Vector3 specificForce(const BaseMotion& base, const BaseAcceleration& acceleration) const;

 private:
  void applyActuators(double since_tick);
  Surroundings::Point endEffector() const;
  const double* surroundingsState(const double* y) const { return y + multibody_->stateDim(); }

  PlantFidelity fidelity_;
  RobotActuators parameters_;
  SpinFriction spin_friction_;
  Vector3 gravity_W_;
  double weight_;
  SlopeForces slope_;
  Vector3 p_BI_B_, p_A3E_;
  Surroundings surroundings_;
  std::unique_ptr<Multibody> multibody_;
  Actuators actuators_;
  bool held_ = false;
  MultibodyLoads loads_;
};

}  // namespace ballbot
