#include "hil/identify/validation.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

Validation judged(const Record& record, const char* what, double left, double whole, double growth,
                  const ValidationLimits& limits) {
  Validation v;
  v.record = std::string(toText(record.posture)) + ": " + record.name;
  v.what = what;
  v.fit_percent = 100 * (1 - left / std::max(whole, 1e-300));
  v.growth = growth;
  v.good = v.fit_percent >= limits.least_fit_percent && v.growth <= limits.most_growth;
  return v;
}

}  // namespace

Validation validateBalance(const MomentumBalance& held_out, const BalanceVector& balance,
                           double zero, double residual, const ValidationLimits& limits) {
  double mean = 0, whole = 0;
  for (int i = 0; i < held_out.size(); ++i) mean += held_out.motorTorque(i) / held_out.size();
  for (int i = 0; i < held_out.size(); ++i) {
    whole += std::pow(held_out.motorTorque(i) - mean, 2) / held_out.size();
  }
  const double left = residualOf(held_out, balance, zero);
  return judged(held_out.record(), "motor torque", left, std::sqrt(whole), left / residual, limits);
}

Validation validateLoop(const Record& held_out, const std::vector<LoopLine>& lines,
                        const DriveLoop& loop, double k0, double residual,
                        const ValidationLimits& limits) {
  double left = 0, whole = 0;
  for (const LoopLine& line : lines) {
    const Complex error = loopError(line, loop, k0, held_out.period).shown;
    left += std::norm(error);
    whole += std::norm(k0 * line.deflection);
  }
  const double part = std::sqrt(left / (2 * static_cast<double>(lines.size())));
  return judged(held_out, "deflection", std::sqrt(left), std::sqrt(whole), part / residual, limits);
}

Validation validateResponse(const Record& held_out, const std::vector<LoopLine>& lines,
                            const TorqueResponse& response, const ValidationLimits& limits) {
  double left = 0, whole = 0, relative = 0;
  for (const LoopLine& line : lines) {
    const Complex error =
        response.sampledAt(line.frequency_Hz, held_out.period) - line.shown / line.sent;
    left += std::norm(error * line.sent);
    whole += std::norm(line.shown);
    relative += std::norm(error) / static_cast<double>(lines.size());
  }
  return judged(held_out, "torque", std::sqrt(left), std::sqrt(whole),
                std::sqrt(relative) / response.residual, limits);
}

}  // namespace ballbot
