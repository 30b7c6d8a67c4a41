#include "controller/frame_task.hpp"

#include "controller/orientation_error.hpp"
#include "core/config_visitor.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

/// Place of a frame in W [m].
class FramePositionTask final : public AddedTaskOf<3> {
 public:
  FramePositionTask(const std::string& name, const RobotFrame& frame, const RobotParameters& robot,
                    const StateVector& rest)
      : AddedTaskOf(name, frameKinematics(robot, frame, rest).p_WF), robot_(robot), frame_(frame) {}

  CommandKind commandKind() const noexcept override { return CommandKind::kPlace; }
  Vector3 present(const StateVector& x) const noexcept override {
    return frameKinematics(robot_, frame_, x).p_WF;
  }
  void residual(const StateVector& x, const Vector3& reference, Vector3& e,
                TaskJacobian* J) const noexcept override {
    const FrameKinematics f = frameKinematics(robot_, frame_, x);
    e = f.p_WF - reference;
    if (J) J->leftCols<kPositionDim>() = f.dpose_dq.topRows<3>();
  }

 private:
  RobotParameters robot_;
  RobotFrame frame_;
};

/// Sine of half the angle about the axes of W; the reference is yaw, pitch, roll [rad].
class FrameOrientationTask final : public AddedTaskOf<3> {
 public:
  FrameOrientationTask(const std::string& name, const RobotFrame& frame,
                       const RobotParameters& robot, const StateVector& rest)
      : AddedTaskOf(name, yawPitchRollFromRotation(frameKinematics(robot, frame, rest).R_WF)),
        robot_(robot),
        frame_(frame) {}

  CommandKind commandKind() const noexcept override { return CommandKind::kOrientation; }
  Vector3 present(const StateVector& x) const noexcept override {
    return yawPitchRollFromRotation(frameKinematics(robot_, frame_, x).R_WF);
  }
  void residual(const StateVector& x, const Vector3& reference, Vector3& e,
                TaskJacobian* J) const noexcept override {
    const FrameKinematics f = frameKinematics(robot_, frame_, x);
    const OrientationError turn = orientationError(
        rotationFromYawPitchRoll(reference[0], reference[1], reference[2]), f.R_WF);
    e = turn.e;
    if (J) J->leftCols<kPositionDim>() = turn.byRotation() * f.dpose_dq.bottomRows<3>();
  }

 private:
  RobotParameters robot_;
  RobotFrame frame_;
};

void describeFrame(ConfigVisitor& v, const RobotParameters& robot, const StateVector& rest,
                   std::vector<std::shared_ptr<const AddedTask>>& tasks) {
  std::string name = "frame";
  std::size_t body = 0;
  RobotFrame frame;
  v.text(must("name", "of the frame's tasks in records: cost_NAME_position"), name);
  const std::vector<std::string> bodies = frameBodies(robot);
  v.chooseIndex(must("body", "which part of the robot it is fixed to"), body, bodies);
  frame = frameOf(robot, bodies[body]);
  Vector3 point = Vector3::Zero();
  v.vector(may("point_m", "origin of the frame, from the body's own"), point, {-10, 10});
  frame.p_LF += frame.R_LF * point;
  const auto section = [&](const char* key, const char* words, std::shared_ptr<AddedTask> task) {
    v.section(may(key, words), [&](ConfigVisitor& in) {
      task->describe(in);
      tasks.push_back(task);
    });
  };
  section("position", "its place in the world, x, y and z",
          std::make_shared<FramePositionTask>(name + "_position", frame, robot, rest));
  section("orientation", "its orientation; the reference is yaw, pitch, roll",
          std::make_shared<FrameOrientationTask>(name + "_orientation", frame, robot, rest));
}

}  // namespace

Registry<TaskKind>& taskKinds() {
  static Registry<TaskKind> kinds({});
  return kinds;
}

void describeFrameTasks(ConfigVisitor& v, const RobotParameters& robot, const StateVector& rest,
                        std::vector<std::shared_ptr<const AddedTask>>& tasks) {
  v.list(may("frames", "any frames of the robot, each held or led like the end-effector"),
         [&](ConfigVisitor& in) { describeFrame(in, robot, rest, tasks); });
}

}  // namespace ballbot
