#include "controller/solver_settings.hpp"

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

void describe(ConfigVisitor& v, Horizon& horizon) {
  v.number(may("length_s", "how far a plan looks ahead"), horizon.length, {0.1, 10});
  v.number(may("step_ms", "from knot to knot of the plan, after its fine part"),
           horizon.coarse_step, {1, 200}, kSecondsPerMs);
  v.number(may("fine_length_s",
               "part at the beginning that has finer steps, a whole multiple of them; at most all "
               "of it"),
           horizon.fine_length, v.depending({0, horizon.length}));
  v.number(may("fine_step_ms", "from knot to knot in the fine part"), horizon.fine_step, {1, 200},
           kSecondsPerMs);
}

void requireWholeSteps(const ConfigReader& in, const Horizon& horizon) {
  demandWhole(in, "fine_length_s", horizon.fine_length, horizon.fine_step);
  demandWhole(in, "length_s", horizon.length - horizon.fine_length, horizon.coarse_step);
}

void describe(ConfigVisitor& v, FrequencyShaping& shaping) {
  bool enabled = true, matched = false;
  v.boolean(may("enabled", "whether fast torques of the wheels cost more than slow ones"), enabled);
  v.other(
      may("actuator_bandwidth_Hz",
          "sets zero and pole, in place of the two, to suit drives whose torque is down 3 dB "
          "there"),
      "number, 0.1 to 10000", [&](ConfigReader& in) {
        if (in.has("zero_rad_per_s") || in.has("pole_rad_per_s")) {
          throw InputError(
              fmt::format("{} stands beside zero_rad_per_s or pole_rad_per_s, must be the "
                          "one or the other",
                          in.at("actuator_bandwidth_Hz")));
        }
        shaping = FrequencyShaping::forBandwidth(in.number("actuator_bandwidth_Hz", {0.1, 1e4}));
        matched = true;
      });
  if (!matched) {
    v.number(may("zero_rad_per_s", "frequency from which on a wheel's torque costs more"),
             shaping.zero, {0.1, 1e5});
    v.number(may("pole_rad_per_s",
                 "frequency beyond which that weight grows no further; at least the zero, "
                 "and the farther above it the more fast torques cost"),
             shaping.pole, v.depending({shaping.zero, 1e5}));
  }
  if (!enabled) shaping.pole = shaping.zero;
}

}  // namespace ballbot
