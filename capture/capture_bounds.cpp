#include "capture/capture_bounds.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/angle.hpp"
#include "experiment/scenario_variants.hpp"

namespace ballbot {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

double endlessIfUnlimited(double limit) { return limit < kUnlimited ? limit : kNoEnd; }

/// All that decides a bound but the push's duration and direction.
struct BoundCase {
  BalanceModel model;
  BalanceLimits limits;

  bool sameAs(const BoundCase& o) const {
    const auto& a = model;
    const auto& b = o.model;
    return a.A == b.A && a.B == b.B && a.E == b.E && a.wheel_rates == b.wheel_rates &&
           a.momentum_rate == b.momentum_rate && a.torque_at_rest == b.torque_at_rest &&
           a.weight == b.weight && limits.wheel_torque == o.limits.wheel_torque &&
           limits.wheel_speed == o.limits.wheel_speed && limits.tilt == o.limits.tilt &&
           a.normal_force.by_torque == b.normal_force.by_torque &&
           limits.floor_friction == o.limits.floor_friction &&
           limits.wheel_friction == o.limits.wheel_friction;
  }
};

CaptureBound boundOf(const BoundCase& c, double duration_s, const BoundRequest& wanted,
                     int directions, const std::function<void()>& one_done) {
  CaptureBound out;
  for (int i = 0; i < directions * wanted.per_direction; ++i) {
    const double deg = 360.0 * i / (directions * wanted.per_direction);
    PushTimes times;
    times.duration_s = duration_s;
    out.angle_deg.push_back(deg);
    out.known_N.push_back(largestPush(c.model, c.limits, times, kRadPerDeg * deg));
    times.blind_s = wanted.blind_s;
    out.blind_N.push_back(largestPush(c.model, c.limits, times, kRadPerDeg * deg));
    one_done();
  }
  return out;
}

}  // namespace

BalanceLimits balanceLimits(const RunConfig& config, double tilt_limit_deg) {
  const PlantConfig& plant = config.plant.plant;
  BalanceLimits out;
  out.wheel_torque =
      std::min(plant.robot.wheel_torque_limit,
               config.controller.tracker.torque_limit.head<kWheelCount>().maxCoeff());
  const bool speed_limited =
      plant.fidelity.actuators == ActuatorLevel::kSeriesElastic && plant.fidelity.speed_limit;
  out.wheel_torque = endlessIfUnlimited(out.wheel_torque);
  out.wheel_speed = speed_limited ? endlessIfUnlimited(plant.robot.wheel_speed_limit) : kNoEnd;
  out.tilt = kRadPerDeg * tilt_limit_deg;
  out.floor_friction = plant.floor.friction;
  if (plant.fidelity.wheels_slip) out.wheel_friction = plant.wheel_contact.friction;
  return out;
}

std::vector<CaptureBound> captureBounds(const CaptureRequest& request, const BoundRequest& wanted,
                                        const ConfigNode& scenario_tree,
                                        const std::function<void(double)>& progress) {
  const std::size_t durations = request.durations_s.size(), heights = request.heights_m.size();
  const std::size_t count = request.variants.size() * durations * heights;
  const double per_bound = request.directions * wanted.per_direction;
  std::vector<CaptureBound> out;
  std::vector<std::vector<BoundCase>> seen(request.variants.size());
  for (std::size_t v = 0; v < request.variants.size(); ++v) {
    std::vector<std::string> overrides = request.overrides;
    const std::vector<std::string>& own = request.variants[v].overrides;
    overrides.insert(overrides.end(), own.begin(), own.end());
    const RunConfig config = readRunConfig(readScenario(scenario_tree, overrides));
    const RobotParameters& robot = config.plant.plant.robot;
    for (const double height_m : request.heights_m) {
      seen[v].push_back({BalanceModel::of(robot, robot.nominal_arm, Vector3(0, 0, height_m)),
                         balanceLimits(config, wanted.tilt_limit_deg)});
    }
    for (std::size_t d = 0; d < durations; ++d) {
      for (std::size_t h = 0; h < heights; ++h) {
        std::size_t same = 0;
        while (same < v && !seen[v][h].sameAs(seen[same][h])) ++same;
        if (same < v) {
          out.push_back(out[(same * durations + d) * heights + h]);
          continue;
        }
        double done = per_bound * static_cast<double>(out.size());
        out.push_back(boundOf(seen[v][h], request.durations_s[d], wanted, request.directions, [&] {
          progress(++done / (per_bound * static_cast<double>(count)));
        }));
      }
    }
  }
  progress(1);
  return out;
}

}  // namespace ballbot
