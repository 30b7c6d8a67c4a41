#include "tools/paper_experiments.hpp"

#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace ballbot {
namespace {

/// A metric of a run; not a number where the run produced none.
double metricOf(const RunResult& result, const std::string& name) {
  const auto it = result.metrics.find(name);
  return it == result.metrics.end() ? std::nan("") : it->second;
}

}  // namespace

const std::vector<PaperExperiment>& paperExperiments() {
  static const std::vector<PaperExperiment> all = {
      {"ee_pose_tracking",
       "End-effector pose, ball free",
       "The end-effector follows steps of its pose; the ball moves as balance needs it, first "
       "against the step. A "
       "rotation that the robot cannot do without losing its balance is not followed.",
       "Steps in x, y, yaw, pitch and roll on one run.",
       {"ee_x_rise_s", "ee_y_rise_s", "ee_yaw_rise_s", "ee_pitch_rise_s", "ee_x_overshoot_percent",
        "ee_position_error_m", "ee_roll_given_percent", "ball_backs_up_m"},
       {"ee", "ee_angles", "ball"}},
      {"disturbance_ball",
       "Pushes while the ball holds its place",
       "Pushed by hand along y, then along x, the base leans against the push and the ball "
       "returns.",
       "The hand is a force of 20 N for half a second.",
       {"largest_push_excursion_m", "longest_push_return_s", "least_lean_against_push_deg",
        "largest_tilt_deg", "largest_push_arm_excursion_rad"},
       {"ball", "tilt", "arm"}},
      {"disturbance_ee",
       "Pushes while the end-effector holds its place",
       "The end-effector stays where it is; ball and arm move to make that possible.",
       "The same pushes as before.",
       {"largest_push_ee_excursion_m", "longest_push_ee_return_s", "largest_push_arm_excursion_rad",
        "largest_tilt_deg"},
       {"ee", "ball", "arm"}},
      {"whole_body_sequence",
       "End-effector sequence with a payload, whole body",
       "The end-effector goes through a sequence of places; the ball keeps its own.",
       "The payload is 1 kg, and the model knows of it.",
       {"rms_ball_excursion_m", "largest_ball_excursion_m", "ee_position_error_m",
        "largest_tilt_deg", "feedforward_share_wheels_percent", "feedforward_share_arm2_percent"},
       {"ee", "ball", "tilt"}},
      {"whole_body_sequence_decoupled",
       "The same with base and arm controlled apart",
       "With an MPC for the base alone and inverse kinematics with joint PID for the arm, the ball "
       "drifts.",
       "Both parts know of the payload, but the base not of where the arm is; weights tuned for "
       "it.",
       {"rms_ball_excursion_m", "largest_ball_excursion_m", "rms_ee_tracking_error_m",
        "largest_tilt_deg"},
       {"ee", "ball", "tilt"}},
      {"circle",
       "The ball on a circle, the end-effector still",
       "Two tasks at once: the ball follows a circle while the end-effector stays in its place in "
       "the world.",
       "Radius 0.1 m, twice around in 20 s.",
       {"rms_ball_tracking_error_m", "largest_ball_tracking_error_m", "rms_ee_tracking_error_m",
        "largest_ee_tracking_error_m"},
       {"ball", "ee", "arm"}},
      {"door_5N",
       "Opening a door with 5 N",
       "Asked for a force on the door, the robot leans into it and follows as the door gives way.",
       "The door has a mass, a damper and friction; the force is felt through the joints.",
       {"force_mean_error_percent", "force_rms_error_percent", "final_door_angle_deg",
        "push_lean_deg", "com_shift_error_percent"},
       {"force", "door", "tilt"}},
      {"door_10N",
       "Opening a door with 10 N",
       "Twice the force takes a larger lean.",
       "A stiffer damper and more friction.",
       {"force_mean_error_percent", "force_rms_error_percent", "final_door_angle_deg",
        "push_lean_deg", "com_shift_error_percent"},
       {"force", "door", "tilt"}}};
  return all;
}

std::vector<Comparison> compareExperiments(const std::map<std::string, RunResult>& results) {
  std::vector<Comparison> out;
  const auto with =
      [&](const char* first, const char* second,
          const std::function<Comparison(const RunResult&, const RunResult&)>& judge) {
        const auto a = results.find(first), b = results.find(second);
        if (a != results.end() && b != results.end()) out.push_back(judge(a->second, b->second));
      };
  with("whole_body_sequence", "whole_body_sequence_decoupled",
       [](const RunResult& whole, const RunResult& apart) {
         const double rms = metricOf(whole, "rms_ball_excursion_m"),
                      other = metricOf(apart, "rms_ball_excursion_m");
         return Comparison{
             "Controlled apart, the ball strays at least twice as far as the whole body's",
             fmt::format("{:.3f} m rms against {:.3f} m", other, rms),
             !whole.fell && !apart.fell && other >= 2 * rms};
       });
  with("disturbance_ball", "disturbance_ee", [](const RunResult& ball, const RunResult& ee) {
    const double still = metricOf(ball, "largest_push_arm_excursion_rad");
    const double busy = metricOf(ee, "largest_push_arm_excursion_rad");
    return Comparison{
        "To hold the end-effector against a push the arm moves at least twice as far as to hold "
        "the ball",
        fmt::format("{:.2f} rad against {:.2f} rad", busy, still), busy >= 2 * still};
  });
  with("door_5N", "door_10N", [](const RunResult& five, const RunResult& ten) {
    const double small = metricOf(five, "push_lean_deg"), large = metricOf(ten, "push_lean_deg");
    return Comparison{"The lean grows with the force asked of the door",
                      fmt::format("{:.2f} deg at 5 N, {:.2f} deg at 10 N", small, large),
                      small > 0 && large > small};
  });
  return out;
}

}  // namespace ballbot
