#include "controller/horizon.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr double kSecondsPerMs = 1e-3;

void demandWhole(const ConfigReader& in, const char* key, double length, double step) {
  const double steps = length / step;
  if (std::abs(steps - std::round(steps)) > 1e-6) {
    throw InputError(fmt::format("{} leaves {:.6g} steps of {:.6g} ms, must be a whole number",
                                 in.at(key), steps, 1e3 * step));
  }
}

}  // namespace

std::vector<double> Horizon::knots() const {
  const int fine = static_cast<int>(std::lround(fine_length / fine_step));
  const int coarse = static_cast<int>(std::lround((length - fine_length) / coarse_step));
  std::vector<double> out;
  for (int k = 0; k <= fine; ++k) out.push_back(k * fine_step);
  for (int k = 1; k <= coarse; ++k) out.push_back(fine_length + k * coarse_step);
  return out;
}

void Horizon::describe(ConfigVisitor& v) {
  v.number(may("length_s", "how far a plan looks ahead"), length, {0.1, 10});
  v.number(may("step_ms", "from knot to knot of the plan, after its fine part"), coarse_step,
           {1, 200}, kSecondsPerMs);
  v.number(may("fine_length_s",
               "part at the beginning that has finer steps, a whole multiple of them; at most all "
               "of it"),
           fine_length, v.depending({0, length}));
  v.number(may("fine_step_ms", "from knot to knot in the fine part"), fine_step, {1, 200},
           kSecondsPerMs);
}

void Horizon::requireWholeSteps(const ConfigReader& in) const {
  demandWhole(in, "fine_length_s", fine_length, fine_step);
  demandWhole(in, "length_s", length - fine_length, coarse_step);
}

}  // namespace ballbot
