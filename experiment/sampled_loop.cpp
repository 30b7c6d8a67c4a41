#include "experiment/sampled_loop.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "controller/floor_hold.hpp"
#include "core/error.hpp"
#include "solver/spectral_radius.hpp"

namespace ballbot {
namespace {

constexpr SimDuration kLeastTime = std::chrono::milliseconds(50);

/// Behind the plant's state. Of the base there are place (2), angles (3), velocity (2), angular
/// velocity (3) and the ball's acceleration (2).
enum LoopIndex : int {
  kFilterState = SampledLoop::kFilter,
  kCommand = kFilterState + kFilterDim,
  kActiveStart = kCommand + kTrackerOutputDim,
  kPendingStart = kActiveStart + kPlanStartDim,
  kSample = kPendingStart + kPlanStartDim,
  kPlace = 0,
  kAngles = 2,
  kVelocity = 5,
  kRates = 7,
  kAcceleration = 10,
  kBaseDim = 12,
  kEstimate = kSample + kBaseDim,
  kArmAngle = kEstimate + kBaseDim,
  kArmRate = kArmAngle + kArmJointCount,
  kLines = kArmRate + kArmJointCount
};

/// A delay line of as many values as `line` has, the newest last: takes `value` in, gives the one
/// that comes out.
template <typename Vector>
void passThrough(Eigen::Ref<Eigen::VectorXd> line, Vector& value) {
  const auto n = value.size();
  if (line.size() == 0) return;
  const Vector out = line.head(n);
  std::copy(line.data() + n, line.data() + line.size(), line.data());
  line.tail(n) = value;
  value = out;
}

int indexOf(std::vector<SimDuration>& values, SimDuration value) {
  const auto found = std::find(values.begin(), values.end(), value);
  const auto index = found - values.begin();
  if (found == values.end()) values.push_back(value);
  return static_cast<int>(index);
}

LawRest restOf(const RobotParameters& robot) {
  const Equilibrium rest = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm);
  LawRest out{rest.x, rest.tau, JointVector::Zero()};
  out.joint_angle.tail<kArmJointCount>() = robot.nominal_arm;
  return out;
}

}  // namespace

SampledLoop::SampledLoop(const RunConfig& config, SimTime at)
    : plant_(config.plant.plant),
      schedule_(makeLoopSchedule(loopPeriods(config))),
      tracker_(config.controller.tracker),
      drive_period_(config.plant.plant.drive_period),
      transport_ticks_(config.plant.plant.fidelity.transport_delay
                           ? config.plant.plant.transport_delay_ticks
                           : 0),
      inserted_(config.plant.plant.wheel_loop),
      imu_period_(toSeconds(config.plant.plant.sensors.imu.period)) {
  const RobotParameters& robot = config.believedRobot();
  const auto cost = config.controller.law->costAt(at, robot.nominal_arm);
  const Rates& rates = config.scenario.rates;
  filter_keep_ = std::exp(-(cost ? cost->shaping.pole : 0) * toSeconds(rates.tracker));
  const double arm_time = config.estimator->armRateTimeConstant();
  arm_rate_keep_ = arm_time > 0 ? std::exp(-toSeconds(rates.estimator) / arm_time) : 0;

  std::vector<SimDuration> ages, ways;
  for (const LoopEvent& event : schedule_.events) {
    flight_of_.push_back(indexOf(ways, event.until_next));
    law_of_.push_back(event.track ? indexOf(ages, event.plan_age) : 0);
  }
  for (const SimDuration way : ways) flights_.push_back(plant_.flightOver(way));
  const std::unique_ptr<ControlLaw> law = config.controller.law->makeLawAtRest(at);
  Circumstances at_rest;
  at_rest.floor_held = FloorHold(robot, config.controller.floor).held();
  law->setCircumstances(at_rest);
  law_ = linearizeLaw(*law, tracker_, restOf(robot), at, ages);
}

int SampledLoop::dim(const LoopProbe& probe) const {
  return kLines + transport_ticks_ * kTrackerOutputDim +
         kWheelCount * (inserted_.delay_ticks + probe.wheel_ticks) + kJointCount * probe.all_ticks;
}

void SampledLoop::sampleImu(State z) const {
  const StateVector x = z.segment<kStateDim>(kRobot);
  auto sample = z.segment<kBaseDim>(kSample);
  const Vector3 turned = x.segment<3>(kYaw) - sample.segment<3>(kAngles);
  const Eigen::Vector2d gained =
      x.segment<2>(kPositionDim + kBallVx) - sample.segment<2>(kVelocity);
  sample << x.segment<2>(kBallX), x.segment<3>(kYaw), x.segment<2>(kPositionDim + kBallVx),
      plant_.angleRates().inverse() * turned / imu_period_, gained / imu_period_;
}

void SampledLoop::takeEstimate(State z) const {
  z.segment<kBaseDim>(kEstimate) = z.segment<kBaseDim>(kSample);
  const auto plant = z.head<LoopPlant::kDim>();
  z.segment<kArmJointCount>(kArmAngle) = plant_.jointAngle(plant).tail<kArmJointCount>();
  auto rate = z.segment<kArmJointCount>(kArmRate);
  rate = arm_rate_keep_ * rate +
         (1 - arm_rate_keep_) * plant_.jointVelocity(plant).tail<kArmJointCount>();
}

StateVector SampledLoop::estimate(const LoopEvent& event, const State& z) const {
  const auto base = z.segment<kBaseDim>(kEstimate);
  const double ahead = toSeconds(event.imu_age);
  const auto velocity = base.segment<2>(kVelocity);
  const auto acceleration = base.segment<2>(kAcceleration);
  const auto rates = base.segment<3>(kRates);
  StateVector x;
  x << base.segment<2>(kPlace) + ahead * velocity + 0.5 * ahead * ahead * acceleration,
      base.segment<3>(kAngles) + ahead * (plant_.angleRates() * rates),
      z.segment<kArmJointCount>(kArmAngle) +
          toSeconds(event.frame_age) * z.segment<kArmJointCount>(kArmRate),
      velocity + ahead * acceleration, rates, z.segment<kArmJointCount>(kArmRate);
  return x;
}

void SampledLoop::plan(const LoopEvent& event, State z) const {
  PlanStartVector start;
  start << estimate(event, z), z.segment<kFilterDim>(kFilterState),
      plant_.jointAngle(z.head<LoopPlant::kDim>());
  z.segment<kPlanStartDim>(kPendingStart) = start;
  if (event.at_once) z.segment<kPlanStartDim>(kActiveStart) = start;
}

void SampledLoop::track(const LoopEvent& event, const LinearCommand& law, State z) const {
  const auto plant = z.head<LoopPlant::kDim>();
  TrackerInputVector now;
  now << estimate(event, z), z.segment<kFilterDim>(kFilterState), plant_.jointAngle(plant),
      plant_.jointVelocity(plant);
  auto command = z.segment<kTrackerOutputDim>(kCommand);
  command = law.by_start * z.segment<kPlanStartDim>(kActiveStart) + law.by_now * now;
  auto filter = z.segment<kFilterDim>(kFilterState);
  filter = filter_keep_ * filter + (1 - filter_keep_) * command.segment<kFilterDim>(kTorqueOut);
}

void SampledLoop::drive(const LoopProbe& probe, State z) const {
  Eigen::Index line = kLines;
  const auto through = [&](Eigen::Index length, auto& value) {
    passThrough(z.segment(line, length), value);
    line += length;
  };
  Eigen::Matrix<double, kTrackerOutputDim, 1> arrived = z.segment<kTrackerOutputDim>(kCommand);
  through(transport_ticks_ * kTrackerOutputDim, arrived);
  JointVector wanted =
      arrived.segment<kJointCount>(kTorqueOut) + arrived.segment<kJointCount>(kSetPointOut);
  if (tracker_.pd_loop == TrackerConfig::PdLoop::kDrives) {
    wanted -= tracker_.stiffness.cwiseProduct(z.segment<kJointCount>(LoopPlant::kJointAngle)) +
              tracker_.damping.cwiseProduct(z.segment<kJointCount>(LoopPlant::kJointVelocity));
  }
  Vector3 wheels = inserted_.gain * probe.wheel_gain * wanted.head<kWheelCount>();
  through(kWheelCount * (inserted_.delay_ticks + probe.wheel_ticks), wheels);
  wanted.head<kWheelCount>() = wheels;
  through(kJointCount * probe.all_ticks, wanted);
  plant_.act(wanted, z.head<LoopPlant::kDim>());
}

void SampledLoop::pass(std::size_t n, const LoopProbe& probe, State z) const {
  const LoopEvent& event = schedule_.events[n];
  if (event.imu) sampleImu(z);
  if (event.drives) plant_.sense(z.head<LoopPlant::kDim>());
  if (event.estimate) takeEstimate(z);
  if (event.activate) {
    z.segment<kPlanStartDim>(kActiveStart) = z.segment<kPlanStartDim>(kPendingStart);
  }
  if (event.plan) plan(event, z);
  if (event.track) track(event, law_[law_of_[n]], z);
  if (event.drives) drive(probe, z);
  LoopPlant::fly(flights_[flight_of_[n]], z.head<LoopPlant::kDim>());
}

void SampledLoop::advance(const LoopProbe& probe, State z) const {
  for (std::size_t n = 0; n < schedule_.events.size(); ++n) pass(n, probe, z);
}

double SampledLoop::growthRate(const LoopProbe& probe) const {
  // Over a period of a tick all eigenvalues are next to 1, where an iteration cannot tell them
  // apart.
  const auto periods = 1 + (kLeastTime - SimDuration(1)) / schedule_.period;
  const auto map = [&](Eigen::VectorXd& z) {
    for (std::int64_t i = 0; i < periods; ++i) advance(probe, z);
  };
  const double radius = spectralRadius(map, dim(probe));
  return std::log(radius) / (static_cast<double>(periods) * toSeconds(schedule_.period));
}

}  // namespace ballbot
