#pragma once

#include <vector>

#include "controller/linear_law.hpp"
#include "experiment/loop_plant.hpp"
#include "experiment/loop_schedule.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {

/// What is put into a loop to find out how much of it the loop can take, between the torques wanted
/// on the joints and their torque loops: as plant.wheel_loop_insertion, which it comes on top of.
struct LoopProbe {
  double wheel_gain = 1;
  int wheel_ticks = 0;  ///< of delay, of the drives
  int all_ticks = 0;    ///< of delay, at wheels and arm
};

/// The closed loop of a scenario about rest as it runs, linear, over one period of its schedule:
/// plant and drives (LoopPlant), transport delay, estimator, plans with their latency, tracker
/// (LinearCommand). All values are deviations from rest.
///
/// Of the estimator there is what it does without noise: tilt and place at the IMU's samples, base
/// rates as means over its period, all brought forward to now; the arm's rates through its low
/// pass. Biases, gates and the slow correction of the tilt are left out, and so are the ball's spin
/// and the floor's limited hold on it, beyond what the first plan counts on.
class SampledLoop {
 public:
  /// @param at  when the tasks' weights are read
  /// @throw InputError for rates that do not come together; NumericalError as linearizeLaw.
  SampledLoop(const RunConfig& config, SimTime at);

  const LoopSchedule& schedule() const { return schedule_; }
  SimDuration drivePeriod() const { return drive_period_; }

  int dim(const LoopProbe& probe) const;
  /// Takes a state over what happens at one event of the schedule, and to the next.
  void pass(std::size_t event, const LoopProbe& probe, Eigen::Ref<Eigen::VectorXd> z) const;
  /// The same over the whole period.
  void advance(const LoopProbe& probe, Eigen::Ref<Eigen::VectorXd> z) const;

  /// At what rate a disturbance grows at last, or dies where it is negative: from the spectral
  /// radius of the map over one period [1/s].
  double growthRate(const LoopProbe& probe) const;

  /// The robot's state (q, nu), the first elements of a state.
  static constexpr int kRobot = LoopPlant::kX;
  /// That of the shaping filter, x_f.
  static constexpr int kFilter = LoopPlant::kDim;

 private:
  using State = Eigen::Ref<Eigen::VectorXd>;

  void sampleImu(State z) const;
  void takeEstimate(State z) const;
  StateVector estimate(const LoopEvent& event, const State& z) const;
  void plan(const LoopEvent& event, State z) const;
  void track(const LoopEvent& event, const LinearCommand& law, State z) const;
  void drive(const LoopProbe& probe, State z) const;

  LoopPlant plant_;
  LoopSchedule schedule_;
  std::vector<LoopPlant::Flight> flights_;
  std::vector<LinearCommand> law_;       ///< one per age of a plan at which it is tracked
  std::vector<int> flight_of_, law_of_;  ///< of each event, into these
  TrackerConfig tracker_;
  SimDuration drive_period_;
  int transport_ticks_;
  LoopInsertion inserted_;
  double filter_keep_;    ///< share of x_f that is left after one tracker period
  double arm_rate_keep_;  ///< of the arm's estimated rate, after one period of the estimator
  double imu_period_;     ///< [s]
};

}  // namespace ballbot
