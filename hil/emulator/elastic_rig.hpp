#pragma once

#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "cosim/participant.hpp"
#include "hil/emulator/elastic_joint.hpp"

namespace ballbot {

struct ElasticRigOptions {
  ElasticJointParameters joint;             ///< of all six
  StandOutput output = StandOutput::kFree;  ///< until told otherwise
  std::uint64_t noise_seed = 1;
};

/// Six series elastic joints on a test stand in the robot's place, with friction, backlash, delay
/// and noise that are to be found: each its own, the base standing upright and still.
class ElasticRig final : public Participant, public TestStand {
 public:
  explicit ElasticRig(const ElasticRigOptions& options);

  StandOutput output(int joint) const override { return joints_.at(index(joint)).output(); }
  void setOutput(int joint, StandOutput output) override {
    joints_.at(index(joint)).setOutput(output);
  }
  double motorTorque(int joint) const override { return motor_torque_[joint]; }
  const ElasticJoint& joint(int i) const { return joints_.at(index(i)); }

  std::string name() const override { return "rig"; }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override {}
  /// @throw InputError if the step is no whole number of the drives' ticks.
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  void terminate() override {}
  void reset() override { enterInitializationMode(kSimStart); }
  const SensorFrame& sensors() const override { return sensors_; }
  std::optional<TruthFrame> truth() const override { return std::nullopt; }
  /// @throw CallOrderError: a rig has nothing worth saving.
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  std::uint64_t stateDigest() const override;

 private:
  static std::size_t index(int joint) { return static_cast<std::size_t>(joint); }
  void sampleJoints();
  void sampleImu();

  ElasticRigOptions options_;
  std::vector<ElasticJoint> joints_;
  std::vector<RandomStream> joint_noise_;
  RandomStream gyro_noise_, accel_noise_;
  SensorFrame sensors_;
  JointVector motor_torque_ = JointVector::Zero();
  std::uint64_t samples_ = 0;
};

}  // namespace ballbot
