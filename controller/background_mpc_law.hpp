#pragma once

#include <atomic>
#include <thread>

#include <semaphore.h>

#include "controller/latest_value.hpp"
#include "controller/mpc_execution.hpp"
#include "controller/mpc_planner.hpp"

namespace ballbot {

/// Whole-body MPC with the solver in a thread of its own, for real time. plan() leaves a request
/// and returns at once with the report of the last solve that was finished; activatePlan() takes
/// the newest finished plan, if there is one. No call but the constructor locks, waits or
/// allocates. When a plan is ready depends on the machine: runs that must repeat use MpcLaw.
class BackgroundMpcLaw final : public ControlLaw {
 public:
  BackgroundMpcLaw(const RobotParameters& robot, const MpcConfig& config);
  ~BackgroundMpcLaw() override;

  PlanReport plan(SimTime now, const StateVector& x,
                  const JointVector& joint_angle) noexcept override;
  void setCircumstances(const Circumstances& now) noexcept override {
    circumstances_ = now;
    execution_.setCircumstances(now);
  }
  /// Before the first plan(): then the planner is the solver thread's.
  void setClock(PhaseClock clock) noexcept override { planner_.setClock(clock); }
  void activatePlan() noexcept override;
  void sample(SimTime now, PolicySample& out) const noexcept override;
  void commanded(SimTime now, SimDuration period, const JointVector& torque) noexcept override;

  /// @throw InputError always: what a thread is about to do is no state that can be saved.
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

  /// Solves finished so far.
  std::int64_t solves() const noexcept { return solves_.load(); }

 private:
  struct Request {
    SimTime now{};
    StateVector x = StateVector::Zero();
    Vector3 xf = Vector3::Zero();
    JointVector joint_angle = JointVector::Zero();
    Circumstances circumstances;
    PolicySample stand_in;
  };
  struct Result {
    MpcPolicy policy;  ///< the newest good plan; invalid before there is one
    PlanReport report;
  };
  void solveForever();

  MpcExecution execution_;
  Circumstances circumstances_;

  MpcPlanner planner_;  // the solver thread's alone
  LatestValue<Request> requests_;
  LatestValue<Result> results_;
  sem_t wake_;
  std::atomic<bool> quit_{false};
  std::atomic<std::int64_t> solves_{0};
  std::thread solver_;
};

}  // namespace ballbot
