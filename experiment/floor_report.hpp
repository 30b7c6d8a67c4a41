#pragma once

#include <optional>
#include <vector>

#include "experiment/log_tables.hpp"
#include "report/write_report.hpp"

namespace ballbot {

/// The ball about the vertical, and what holds it; nothing of a ball that cannot spin.
std::optional<PlotGroup> floorGroup(const std::vector<LogTable>& tables);
/// The wheels on the ball; nothing of a plant that does not know their contacts.
std::optional<PlotGroup> wheelGroup(const std::vector<LogTable>& tables);

}  // namespace ballbot
