#include "hil/rehearsal/emulated_person.hpp"

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kWait = 0.8, kTurn = 1.5;  // before and during a motion [s]
constexpr double kTiltAngle = 20 * kRadPerDeg, kYawAngle = 45 * kRadPerDeg;

}  // namespace

void EmulatedPerson::begin(const CommissioningTask& task) {
  task_ = task;
  time_ = 0;
  rig_.setHands({});
  if (listener_ != nullptr) listener_->begin(task);
}

void EmulatedPerson::onCycle() {
  time_ += period_;
  RigHands hands;
  const bool turns = time_ > kWait && time_ <= kWait + kTurn;
  switch (task_.kind) {
    case CommissioningTask::Kind::kTurnJoint:
      hands.joint = task_.drive;
      hands.joint_velocity = turns ? task_.angle / kTurn : 0;
      break;
    case CommissioningTask::Kind::kTiltBase:
      for (std::size_t k = 0; k < 3; ++k) {
        const double angle = (k == 2 ? kYawAngle : kTiltAngle) * task_.axis[k];
        hands.base_rate[k] = turns ? angle / kTurn : 0;
        tilted_[k] = k == 2 ? 0 : angle;  // there is no way back to take from a turn in place
      }
      break;
    case CommissioningTask::Kind::kUpright:
      for (std::size_t k = 0; k < 3; ++k) hands.base_rate[k] = turns ? -tilted_[k] / kTurn : 0;
      break;
    case CommissioningTask::Kind::kStandStill:
    case CommissioningTask::Kind::kTorque:
      break;
  }
  rig_.setHands(hands);
}

}  // namespace ballbot
