#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/random.hpp"
#include "cosim/participant.hpp"

namespace ballbot {

struct JointRigOptions {
  double bandwidth_Hz = 40;  ///< natural frequency of the torque response
  double damping_ratio = 0.7071067811865476;
  double delay_s = 0;    ///< of commands
  bool blocked = false;  ///< the joints do not move: a torque test stand
};

/// What somebody's hands do to a rig: one joint and the base turn as they want.
struct RigHands {
  int joint = -1;                     ///< held and turned; -1: none
  double joint_velocity = 0;          ///< [rad/s]
  std::array<double, 3> base_rate{};  ///< angular velocity in B [rad/s]
};

/// Six independent joints in the robot's place: each a torque actuator of second order,
///
///   tau'' + 2 D w tau' + w^2 tau = w^2 tau_command(t - delay),  w = 2 pi bandwidth
///
/// on an inertia of 0.05 kg m^2 with viscous friction 0.2 N m s/rad, or on a fixed link. Solved in
/// closed form between commands, so that its response is known exactly. The IMU stands upright
/// unless hands turn the base, and has the noise of a real one, along z none: whoever reads it can
/// tell gravity exactly.
class JointRig final : public Participant {
 public:
  explicit JointRig(const JointRigOptions& options);

  std::string name() const override { return "rig"; }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override {}
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  void terminate() override {}
  void reset() override { enterInitializationMode(kSimStart); }
  const SensorFrame& sensors() const override { return sensors_; }
  std::optional<TruthFrame> truth() const override { return std::nullopt; }
  /// @throw CallOrderError: a rig has nothing worth saving.
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  std::uint64_t stateDigest() const override;

  /// In force from the next step on.
  void setHands(const RigHands& hands) { hands_ = hands; }
  /// The vertical in B, unit length.
  const Vector3& up() const { return up_B_; }

 private:
  void advance(double dt, const JointVector& command);
  void turnBase(double dt);
  void sampleImu();

  JointRigOptions options_;
  RandomStream gyro_noise_{1, "rig.gyro_noise"}, accel_noise_{1, "rig.accel_noise"};
  RigHands hands_;
  Vector3 up_B_{0, 0, 1};
  SensorFrame sensors_;
  JointVector torque_ = JointVector::Zero(), torque_rate_ = JointVector::Zero();
  JointVector angle_ = JointVector::Zero(), velocity_ = JointVector::Zero();
  std::vector<std::pair<double, JointVector>> on_the_way_;  ///< when they act [s], and what
  JointVector acting_ = JointVector::Zero();
};

}  // namespace ballbot
