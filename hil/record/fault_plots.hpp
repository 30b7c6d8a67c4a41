#pragma once

#include <vector>

#include "hil/record/fault_record.hpp"
#include "report/report_data.hpp"

namespace ballbot {

/// The recorded cycles as lines over time. What did not come in a cycle is a gap.
std::vector<PlotGroup> faultPlots(const FaultRecord& record);

/// The recorded cycles as states over time: what the bench did, and what each drive said it was in.
PlotGroup faultLanes(const FaultRecord& record);

}  // namespace ballbot
