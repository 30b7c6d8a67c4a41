#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/random.hpp"
#include "cosim/participant.hpp"

namespace ballbot::testing_support {

/// Six masses on springs with a torque each and one noisy sensor: small, stable, with a state that
/// matters and noise that must survive save and restore.
class SpringParticipant : public Participant {
 public:
  explicit SpringParticipant(std::uint64_t seed = 1, bool knows_truth = true)
      : noise_(seed, "spring"), knows_truth_(knows_truth) {}

  std::string name() const override { return "spring"; }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override { measure(); }
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  void terminate() override {}
  void reset() override { *this = SpringParticipant(*this, Fresh{}); }
  const SensorFrame& sensors() const override { return sensors_; }
  std::optional<TruthFrame> truth() const override;
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  std::uint64_t stateDigest() const override;

  /// Throws NumericalError in the step that reaches this time.
  void failAt(SimTime t) { fail_at_ = t; }
  /// Measures nan from this time on.
  void measureNanFrom(SimTime t) { nan_from_ = t; }
  /// A state so large that it needs many messages.
  void carry(std::size_t bytes) { ballast_.assign(bytes, 7); }
  std::int64_t stepsDone() const { return steps_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.time_);
    visit(self.steps_);
    visit(self.position_);
    visit(self.velocity_);
    visit(self.ballast_);
  }

 private:
  struct Fresh {};
  SpringParticipant(const SpringParticipant& other, Fresh)
      : noise_(other.noise_), knows_truth_(other.knows_truth_) {}
  void measure();

  RandomStream noise_;
  bool knows_truth_;
  SimTime time_{};
  JointVector position_ = JointVector::Zero(), velocity_ = JointVector::Zero();
  std::int64_t steps_ = 0;
  SensorFrame sensors_;
  SimTime fail_at_ = SimTime::max(), nan_from_ = SimTime::max();
  StateBlob ballast_;
};

}  // namespace ballbot::testing_support
