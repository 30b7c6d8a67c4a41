#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/scenario.hpp"

namespace ballbot {

/// One requirement held against what was measured.
struct VerdictRow {
  std::string metric;
  double value = 0;
  bool measured = true;  ///< false: the run produced no such number, which counts as missed
  std::string limit;     ///< "< 20", "> 5", "5 to 20"
  bool passed = false;
};

/// @throw InputError if a requirement names a metric that no run produces, listing those known.
std::vector<VerdictRow> judge(const std::vector<MetricLimit>& requirements,
                              const std::map<std::string, double>& metrics,
                              const std::vector<std::string>& known_metrics);

}  // namespace ballbot
