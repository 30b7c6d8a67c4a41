#pragma once

#include "hil/commissioning/commissioning_task.hpp"
#include "hil/emulator/joint_rig.hpp"

namespace ballbot {

/// Does what commissioning asks for, on a rig: waits, turns, rests. Time passes with onCycle().
class EmulatedPerson final : public CommissioningPerson {
 public:
  /// @param rig     must outlive this
  /// @param period    of onCycle() [s]
  /// @param listener  is told the same; null: nobody
  EmulatedPerson(JointRig& rig, double period, CommissioningPerson* listener = nullptr)
      : rig_(rig), period_(period), listener_(listener) {}

  void begin(const CommissioningTask& task) override;
  void hear(const CommissioningTask& task, const std::string& words) override {
    if (listener_ != nullptr) listener_->hear(task, words);
  }
  bool allowsTorque() override { return true; }

  /// Before every SYNC.
  void onCycle();

 private:
  JointRig& rig_;
  double period_;
  CommissioningPerson* listener_;
  CommissioningTask task_;
  double time_ = 0;                 ///< since the task began [s]
  std::array<double, 3> tilted_{};  ///< rotation of the base that is to be taken back [rad]
};

}  // namespace ballbot
