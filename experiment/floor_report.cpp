#include "experiment/floor_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/axes_builder.hpp"
#include "model/state.hpp"

namespace ballbot {
namespace {

bool has(const LogTable* table, const std::string& column) {
  return table != nullptr &&
         std::any_of(table->columns.begin(), table->columns.end(),
                     [&](const LogTable::Column& c) { return c.name == column; });
}

}  // namespace

std::optional<PlotGroup> wheelGroup(const std::vector<LogTable>& tables) {
  if (!has(findTable(tables, "truth"), "wheel_1_normal_force")) return std::nullopt;
  AxesBuilder normal(tables, "normal force", "N");
  AxesBuilder traction(tables, "size of the traction", "N");
  AxesBuilder slip(tables, "slip", "m/s");
  for (int i = 0; i < kWheelCount; ++i) {
    const std::string wheel = fmt::format("wheel_{}_", i + 1);
    const std::string name = fmt::format("wheel {}", i + 1);
    normal.line("truth", wheel + "normal_force", name, SeriesStyle::kMeasured, i);
    traction.size("truth", wheel + "traction", name, SeriesStyle::kMeasured, i);
    slip.line("truth", wheel + "slip", name, SeriesStyle::kMeasured, i);
  }
  return PlotGroup{
      "Wheels on the ball",
      "True forces of the ball on each wheel, and its rim's velocity against the ball. "
      "Friction holds a wheel as long as its traction is below the coefficient times "
      "its normal force.",
      {normal.axes(), traction.axes(), slip.axes()},
      {}};
}

std::optional<PlotGroup> floorGroup(const std::vector<LogTable>& tables) {
  const bool truth = has(findTable(tables, "truth"), "ball_spin_rate");
  const bool estimate = has(findTable(tables, "estimate"), "ball_spin_rate");
  if (!truth && !estimate) return std::nullopt;
  AxesBuilder spin(tables, "spin of the ball", "rad/s");
  AxesBuilder torque(tables, "size of the torque about the vertical", "N m");
  if (truth) {
    spin.line("truth", "ball_spin_rate", "true", SeriesStyle::kMeasured, 0);
    torque.size("truth", "floor_spin_torque", "floor on the ball", SeriesStyle::kMeasured, 0)
        .line("truth", "floor_spin_torque_held", "what the floor holds", SeriesStyle::kReference,
              0);
  }
  if (estimate) {
    spin.line("estimate", "ball_spin_rate", "estimated", SeriesStyle::kEstimated, 0);
    torque.line("estimate", "floor_spin_torque_held", "what the controller believes it holds",
                SeriesStyle::kEstimated, 1);
  }
  return PlotGroup{
      "Ball about the vertical",
      "The floor holds the ball's spin by friction: where the wheels ask for more than "
      "it holds, the ball turns under the robot.",
      {spin.axes(), torque.axes()},
      {}};
}

}  // namespace ballbot
