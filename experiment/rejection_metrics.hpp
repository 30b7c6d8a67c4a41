#pragma once

#include <map>
#include <string>

#include "estimator/rejections.hpp"

namespace ballbot {

/// What an estimator rejected as metrics of a run: "rejected_wheel_2_slip" and so on for every
/// reason, also where it is zero, so that a scenario can demand it of each.
std::map<std::string, double> rejectionMetrics(const RejectionCounts& counts);

/// The other way round: the reasons among `metrics` that were met, without the prefix, with their
/// counts. Empty where nothing was rejected.
std::map<std::string, double> rejectionsAmong(const std::map<std::string, double>& metrics);

/// "wheel_2_slip 37, imu_missing 20"; "nothing" if there are none.
std::string rejectionText(const std::map<std::string, double>& rejections);

}  // namespace ballbot
