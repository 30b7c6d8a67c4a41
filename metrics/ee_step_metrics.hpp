#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "metrics/step_response.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Components of the end-effector's pose: position in W [m], then yaw, pitch, roll of E [rad].
constexpr int kPoseDim = 6;
using PoseVector = Eigen::Matrix<double, kPoseDim, 1>;
PoseVector eePose(const TruthFrame& truth);

/// A step of the reference: at one time, by so much in each component.
struct EeStep {
  SimTime at;
  PoseVector by = PoseVector::Zero();
};

/// How the end-effector follows steps of its reference, and what the ball does first.
class EeStepMetrics {
 public:
  /// @param reference  pose before the first step
  /// @param end  of the run
  EeStepMetrics(const PoseVector& reference, std::vector<EeStep> steps, SimTime end);

  void add(const TruthFrame& truth);

  /// Per component C of x, y, z, yaw, pitch: ee_C_rise_s, ee_C_overshoot_percent; over all steps:
  /// ee_position_error_m, ee_angle_error_rad (largest remaining), ee_roll_given_percent,
  /// ball_backs_up_m. Where a component is stepped several times, the worst counts. Absent without
  /// such a step, and a rise time also if 90 % were never reached.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  struct Component {
    int index;
    StepResponse response;
    StepResponse ball;  ///< the ball's motion along the same axis, for x and y
  };
  std::vector<Component> components_;
};

}  // namespace ballbot
