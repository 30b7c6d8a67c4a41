#pragma once

#include <functional>
#include <memory>
#include <string>

#include "controller/governed_added.hpp"
#include "controller/time_signal.hpp"
#include "core/registry.hpp"
#include "model/robot_parameters.hpp"
#include "model/state.hpp"

namespace ballbot {

constexpr int kMaxTaskDim = 3;

/// Derivative of a residual by the state; rows beyond the task's dimension are zero.
using TaskJacobian = Eigen::Matrix<double, kMaxTaskDim, kStateDim>;

/// Weight and reference of a task at one time; zero beyond its dimension.
struct TaskTarget {
  Vector3 weight = Vector3::Zero(), reference = Vector3::Zero();
};

/// A task beside those that the whole-body cost has a kernel for: 1/2 sum_i w_i e_i(x)^2 is added
/// to the rate of the plan's cost, with the Gauss-Newton Hessian. docs/adding.md walks through one.
class AddedTask {
 public:
  virtual ~AddedTask() = default;

  /// As in the record of a plan, `cost_NAME`, and unique in a plan.
  virtual std::string name() const = 0;
  /// Its keys: the weight, the reference over time, and what it has beside them.
  virtual void describe(ConfigVisitor& v) = 0;
  /// At time t [s] as known at `known` <= t, see TimeSignal::value. Free of allocation.
  virtual void at(double t, double known, TaskTarget& out) const noexcept = 0;
  /// How far its command may lie away at once, see CommandGovernor. What is free may ask the robot
  /// for more than it can do.
  virtual CommandKind commandKind() const noexcept { return CommandKind::kFree; }
  /// Where the robot is, in the terms of the reference; asked only if the command is governed.
  virtual Vector3 present(const StateVector& x) const noexcept {
    (void)x;
    return Vector3::Zero();
  }
  /// e(x), zero beyond the dimension, and de/dx where `J`, which is zero before, is not null. Free
  /// of allocation.
  virtual void residual(const StateVector& x, const Vector3& reference, Vector3& e,
                        TaskJacobian* J) const noexcept = 0;
};

/// One of N components, 1 to 3, with weight and reference as every task has them.
template <int N>
class AddedTaskOf : public AddedTask {
 public:
  /// @param initial  of the reference, where the scenario says nothing
  AddedTaskOf(std::string name, const Eigen::Matrix<double, N, 1>& initial)
      : name_(std::move(name)), reference_(initial) {}

  std::string name() const final { return name_; }
  void describe(ConfigVisitor& v) override {
    weight_.describe(v);
    v.section(may("reference", "what is asked for over time"),
              [&](ConfigVisitor& in) { reference_.describe(in); });
  }
  void at(double t, double known, TaskTarget& out) const noexcept final {
    out.weight.template head<N>() = weight_.value(t, known);
    out.reference.template head<N>() = reference_.value(t, known);
  }

 private:
  std::string name_;
  TimedWeight<N> weight_;
  TimeSignal<N> reference_;
};

/// A task as a scenario asks for it: `controller.mpc.tasks.NAME`.
struct TaskKind {
  std::string name;
  std::string words;
  /// @param rest  of the robot, at the origin
  std::function<std::shared_ptr<AddedTask>(const RobotParameters&, const StateVector& rest)> make;
};

/// None but what others added (docs/adding.md); tasks on frames of the robot need no kind.
Registry<TaskKind>& taskKinds();

}  // namespace ballbot
