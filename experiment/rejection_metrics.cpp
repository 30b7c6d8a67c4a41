#include "experiment/rejection_metrics.hpp"

#include <fmt/format.h>

namespace ballbot {
namespace {

const std::string kPrefix = "rejected_";

}  // namespace

std::map<std::string, double> rejectionMetrics(const RejectionCounts& counts) {
  std::map<std::string, double> out;
  for (int i = 0; i < kRejectionCount; ++i) {
    const auto reason = static_cast<Rejection>(i);
    out[kPrefix + toText(reason)] = static_cast<double>(counts[reason]);
  }
  return out;
}

std::map<std::string, double> rejectionsAmong(const std::map<std::string, double>& metrics) {
  std::map<std::string, double> out;
  for (const auto& [name, value] : metrics) {
    if (name.rfind(kPrefix, 0) == 0 && value != 0) out[name.substr(kPrefix.size())] = value;
  }
  return out;
}

std::string rejectionText(const std::map<std::string, double>& rejections) {
  if (rejections.empty()) return "nothing";
  std::string out;
  for (const auto& [reason, count] : rejections) {
    out += fmt::format("{}{} {:.0f}", out.empty() ? "" : ", ", reason, count);
  }
  return out;
}

}  // namespace ballbot
