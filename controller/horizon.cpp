#include "controller/horizon.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

void demandWhole(ConfigReader& in, const char* key, double length, double step) {
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

Horizon Horizon::read(ConfigReader& in) {
  Horizon h;
  h.length = in.numberOr("length_s", h.length, {0.1, 10});
  h.coarse_step = 1e-3 * in.numberOr("step_ms", 1e3 * h.coarse_step, {1, 200});
  h.fine_length = in.numberOr("fine_length_s", h.fine_length, {0, h.length});
  h.fine_step = 1e-3 * in.numberOr("fine_step_ms", 1e3 * h.fine_step, {1, 200});
  demandWhole(in, "fine_length_s", h.fine_length, h.fine_step);
  demandWhole(in, "length_s", h.length - h.fine_length, h.coarse_step);
  in.finish();
  return h;
}

}  // namespace ballbot
