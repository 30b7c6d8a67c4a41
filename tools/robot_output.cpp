#include "tools/robot_output.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/angle.hpp"
#include "model/limits.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> listed(const ArmVector& v) { return {v.data(), v.data() + v.size()}; }

/// What is zero but for rounding is zero to read.
double shown(double value) { return std::abs(value) < 1e-6 ? 0 : value; }
std::vector<double> shown(const ArmVector& v) {
  std::vector<double> out;
  for (const double value : v) out.push_back(shown(value));
  return out;
}

std::string standingText(const RobotParameters& robot, const RobotSurvey& s) {
  std::string out = fmt::format(
      "{}: {:.4g} kg, of which {:.4g} kg stand on the ball, their centre of mass {:.3g} m above "
      "the "
      "ball's\n\n"
      "in the nominal pose, arm at {:.3g} rad\n"
      "  stands at                      {:.2f} deg pitch, {:.2f} deg roll\n"
      "  holds its arm with             {:.3g} N m, of {:.3g}\n"
      "  falls, arm held, at            {:.3g} 1/s\n",
      robot.name, s.mass, s.mass_on_ball, s.height, fmt::join(shown(robot.nominal_arm), ", "),
      shown(s.pitch * kDegPerRad), shown(s.roll * kDegPerRad), fmt::join(shown(s.arm_torque), ", "),
      robot.arm_torque_limit, s.fall_rate);
  return out +
         fmt::format(
             "  so the loop has to cross 1 at  {:.3g} rad/s or more, with drives of {:.2g} Hz "
             "or more\n",
             s.least_crossover, s.least_bandwidth_Hz);
}

std::string workspaceText(const Workspace& w) {
  if (w.unbalanced == w.poses) return "";
  std::string out = fmt::format(
      "\nover {} poses of the arm, of which {} leave no balance\n"
      "  stands at up to                {:.2f} deg, with the arm at {:.3g} rad\n"
      "  holds its arm with up to       {:.3g} N m\n"
      "  falls at                       {:.3g} to {:.3g} 1/s\n",
      w.poses, w.unbalanced, w.largest_tilt * kDegPerRad, fmt::join(shown(w.most_tilted_arm), ", "),
      fmt::join(shown(w.largest_arm_torque), ", "), w.least_fall_rate, w.largest_fall_rate);
  return out + fmt::format(
                   "  the end-effector reaches       {:.2f} to {:.2f} m from the ball's centre, "
                   "{:.2f} to {:.2f} m above the floor\n",
                   w.least_reach, w.largest_reach, w.least_height, w.largest_height);
}

std::string leanText(const RobotParameters& robot, const RobotSurvey& s) {
  std::string out =
      "\nleaning for good, in the worst of twelve headings\n"
      "  lean, deg   acceleration, m/s2   wheel torque, N m   friction: wheel   floor\n";
  for (const Lean& lean : s.leans) {
    out +=
        fmt::format("  {:>9.3g}{:>21.3g}{:>20.3g}{:>18.2f}{:>8.2f}{}\n", lean.angle * kDegPerRad,
                    lean.acceleration, lean.wheel_torque, lean.wheel_friction, lean.floor_friction,
                    lean.wheel_torque > robot.wheel_torque_limit ? "   beyond the limit" : "");
  }
  out += fmt::format("  {:.3g} N m hold {:.1f} deg: {:.2f} m/s2\n", robot.wheel_torque_limit,
                     s.steepest.angle * kDegPerRad, s.steepest.acceleration);
  out += fmt::format("  a step of 1 m takes            {:.2g} s or more\n", s.metre_s);
  if (s.top_speed >= kUnlimited) return out;
  return out +
         fmt::format(
             "  top speed                      {:.2f} m/s; to brake from there takes {:.2f} m "
             "or more\n",
             s.top_speed, s.braking_distance);
}

Json leanJson(const Lean& lean) {
  return {{"lean_deg", lean.angle * kDegPerRad},
          {"acceleration_m_per_s2", lean.acceleration},
          {"wheel_torque_Nm", lean.wheel_torque},
          {"wheel_friction", lean.wheel_friction},
          {"floor_friction", lean.floor_friction}};
}

}  // namespace

std::string surveyText(const RobotParameters& robot, const RobotSurvey& survey) {
  std::string out =
      standingText(robot, survey) + workspaceText(survey.workspace) + leanText(robot, survey);
  for (const std::string& warning : survey.warnings) out += "\nnote: " + warning;
  return survey.warnings.empty() ? out : out + "\n";
}

Json surveyJson(const RobotParameters& robot, const RobotSurvey& s) {
  const Workspace& w = s.workspace;
  Json out = {{"robot", robot.name},
              {"mass_kg", s.mass},
              {"mass_on_ball_kg", s.mass_on_ball},
              {"centre_of_mass_above_ball_m", s.height},
              {"rest_pitch_deg", s.pitch * kDegPerRad},
              {"rest_roll_deg", s.roll * kDegPerRad},
              {"rest_arm_torque_Nm", listed(s.arm_torque)},
              {"fall_rate_per_s", s.fall_rate},
              {"least_crossover_rad_per_s", s.least_crossover},
              {"least_drive_bandwidth_Hz", s.least_bandwidth_Hz}};
  out["workspace"] = {{"poses", w.poses}, {"unbalanced", w.unbalanced}};
  if (w.unbalanced < w.poses) {
    out["workspace"].update({{"largest_tilt_deg", w.largest_tilt * kDegPerRad},
                             {"most_tilted_arm_rad", listed(w.most_tilted_arm)},
                             {"largest_arm_torque_Nm", listed(w.largest_arm_torque)},
                             {"least_fall_rate_per_s", w.least_fall_rate},
                             {"largest_fall_rate_per_s", w.largest_fall_rate},
                             {"least_reach_m", w.least_reach},
                             {"largest_reach_m", w.largest_reach},
                             {"least_height_m", w.least_height},
                             {"largest_height_m", w.largest_height}});
  }
  for (const Lean& lean : s.leans) out["leans"].push_back(leanJson(lean));
  out["steepest"] = leanJson(s.steepest);
  out["step_of_1_m_s"] = s.metre_s;
  if (s.top_speed < kUnlimited) {
    out["top_speed_m_per_s"] = s.top_speed;
    out["braking_distance_m"] = s.braking_distance;
  }
  out["warnings"] = s.warnings;
  return out;
}

}  // namespace ballbot
