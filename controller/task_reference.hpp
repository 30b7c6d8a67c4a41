#pragma once

#include <memory>

#include "controller/tasks.hpp"
#include "model/motion_reference.hpp"

namespace ballbot {

/// What tasks ask of ball and end-effector.
class TaskReference final : public MotionReference {
 public:
  explicit TaskReference(std::shared_ptr<const TaskSchedule> tasks) : tasks_(std::move(tasks)) {}

  PlaceReference place(SimTime t) const override;
  PoseVector eePose(SimTime t) const override;
  bool eeMoves() const override;
  std::vector<EeStep> eeSteps() const override;

 private:
  std::shared_ptr<const TaskSchedule> tasks_;
};

}  // namespace ballbot
