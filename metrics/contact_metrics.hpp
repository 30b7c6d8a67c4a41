#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "metrics/static_balance.hpp"

namespace ballbot {

/// How well the robot pushes with a force: contact phases, force tracking by phase, and the lean
/// against static balance. Two phases while a force is asked for:
///
///   build-up: from the first touch until what is asked for has not changed for kSteadyAfter;
///   steady: from then on.
///
/// Force is the part of the true contact force along the one asked for. How the force is followed
/// and kept is judged until a door stands at its stop: to push on has no more to do with the door.
class ContactMetrics {
 public:
  /// @param door_stop  where a door is fully open, if there is one [rad]
  explicit ContactMetrics(const RobotParameters& robot,
                          double door_stop = std::numeric_limits<double>::infinity());

  /// @param asked_W   force on the end-effector that the scenario asks for [N]
  /// @param sensed_W  what the controller measures of it [N]
  void add(const TruthFrame& truth, const Vector3& asked_W, const Vector3& sensed_W);

  /// Numbers under their documented names (docs/metrics.md); none if nothing was ever touched and
  /// no force asked for.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  /// Sums over time of one phase.
  struct Sums {
    double time = 0, asked = 0, force = 0, error2 = 0, sensing2 = 0;
    double shift = 0, normal_shift = 0, balanced_shift = 0, lean = 0;
  };
  void addPhase(Sums& sums, double dt, const TruthFrame& truth, const Vector3& asked_W,
                const Vector3& sensed_W);

  RobotParameters robot_;
  double rest_pitch_, door_stop_;
  bool door_open_ = false;
  bool started_ = false, touching_ = false, touched_ = false;
  SimTime last_{}, changed_{};
  double last_asked_ = 0;
  int phases_ = 0;
  double touching_s_ = 0, sliding_s_ = 0, wanted_s_ = 0, kept_s_ = 0;
  double largest_force_ = 0, door_angle_ = 0, largest_door_angle_ = 0;
  bool any_asked_ = false;
  Sums build_up_, steady_;
};

/// What is asked for counts as steady when it has not changed for so long [s].
constexpr double kSteadyAfter = 1.5;

}  // namespace ballbot
