#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "metrics/step_response.hpp"
#include "model/motion_reference.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Where the end-effector is. Of all ways to write its attitude, turns more and the far side of
/// pitch 90 degrees included, the one whose angles are nearest to those of `near`.
PoseVector eePose(const TruthFrame& truth, const PoseVector& near);

/// How the end-effector follows steps of its reference, and what the ball does first.
class EeStepMetrics {
 public:
  /// Steps at one time are one step, and judged until the next.
  /// @param release  times before do not count
  /// @param end  of the run
  EeStepMetrics(std::vector<EeStep> steps, SimTime release, SimTime end);

  /// @param reference  for the end-effector at the truth's time, in the truth's frame
  void add(const TruthFrame& truth, const PoseVector& reference);

  /// Per component C of x, y, z, yaw, pitch: ee_C_rise_s, ee_C_overshoot_percent; over all steps:
  /// ee_position_error_m, ee_angle_error_rad (largest remaining), ee_roll_given_percent,
  /// ball_backs_up_m. Where a component is stepped several times, the worst counts. Absent without
  /// such a step within the run, and a rise time also if 90 % were never reached.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  struct Component {
    int index;
    double by;
    StepResponse response;
    StepResponse ball;  ///< the ball's motion along the same axis, for x and y
    std::optional<double> ball_from;
  };
  SimTime release_;
  std::vector<Component> components_;
};

}  // namespace ballbot
