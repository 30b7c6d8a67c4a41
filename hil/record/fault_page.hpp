#pragma once

#include "hil/record/fault_record.hpp"
#include "report/report_data.hpp"

namespace ballbot {

/// The page of a record: all its seconds, opened at those around the first check. One time axis, in
/// seconds from that check; states, torque asked, sent and felt, motion, IMU and the loop beneath
/// each other; every check that fired marked in all of them; the frames of the cycles around it in
/// words.
ReportData faultPage(const FaultRecord& record);

}  // namespace ballbot
