// What the estimator costs per inertial sample. Its budget is 25 us on one core.
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/complementary_observer.hpp"
#include "estimator/two_state_filter.hpp"
#include "model/omniwheel_kinematics.hpp"

namespace ballbot {
namespace {

constexpr double kPeriod = 2.5e-3;  // of the IMU [s]
constexpr int kCycle = 4000;        // frames after which the motion repeats, 10 s

RobotParameters benchmarkRobot() {
  RobotParameters robot;
  robot.ball.radius = 0.125;
  robot.wheels.radius = 0.064;
  robot.wheels.contact_zenith = std::acos(-1.0) / 4;
  robot.wheels.azimuth = {0, 2 * std::acos(-1.0) / 3, 4 * std::acos(-1.0) / 3};
  robot.p_BI_B << 0.05, 0, 0.3;
  return robot;
}

/// An upright base that is carried to and fro along x by 0.3 m.
std::vector<SensorFrame> shuttle(const RobotParameters& robot) {
  const OmniwheelKinematics kinematics(robot);
  const double w = 2 * std::acos(-1.0) / (kCycle * kPeriod) * 4;
  std::vector<SensorFrame> frames(kCycle);
  Vector3 angle = Vector3::Zero();
  for (int i = 0; i < kCycle; ++i) {
    const double t = (i + 0.5) * kPeriod;
    const Vector3 kappa = OmniwheelKinematics::rollingAngularVelocity(0.3 * w * std::sin(w * t), 0,
                                                                      robot.ball.radius);
    angle += kPeriod * kinematics.wheelRates(kappa, Vector3::Zero());
    frames[static_cast<std::size_t>(i)].joint_angle.head<3>() = angle;
    frames[static_cast<std::size_t>(i)].accel_B << 0.3 * w * w * std::cos(w * t), 0, robot.gravity;
  }
  return frames;
}

void feed(benchmark::State& state, Estimator& estimator, const RobotParameters& robot) {
  const std::vector<SensorFrame> motion = shuttle(robot);
  std::int64_t tick = 0;
  const auto next = [&] {
    SensorFrame frame = motion[static_cast<std::size_t>(tick % kCycle)];
    ++tick;
    frame.imu_count = tick;
    frame.time = frame.imu_time = simTimeFromNs(tick * 2'500'000);
    return frame;
  };
  for (int i = 0; i < 2; ++i) estimator.update(next(), true);
  for (auto _ : state) estimator.update(next(), false);
  if (!estimator.estimate(simTimeFromNs(tick * 2'500'000)).x.allFinite()) {
    state.SkipWithError("the estimate is not finite");
  }
}

/// One update of the two-state filter: two iterations, gates, covariance.
void estimatorUpdate(benchmark::State& state) {
  const RobotParameters robot = benchmarkRobot();
  TwoStateFilter filter(robot, {});
  feed(state, filter, robot);
  state.counters["rejected"] = static_cast<double>(filter.rejections().total());
}
BENCHMARK(estimatorUpdate)->Name("estimator_update")->Unit(benchmark::kMicrosecond);

/// The same with the ball's spin as a state.
void spinEstimatorUpdate(benchmark::State& state) {
  const RobotParameters robot = benchmarkRobot();
  SpinTwoStateFilter filter(robot, {});
  feed(state, filter, robot);
  state.counters["rejected"] = static_cast<double>(filter.rejections().total());
}
BENCHMARK(spinEstimatorUpdate)->Name("spin_estimator_update")->Unit(benchmark::kMicrosecond);

void observerUpdate(benchmark::State& state) {
  const RobotParameters robot = benchmarkRobot();
  ComplementaryObserver observer(robot, {});
  feed(state, observer, robot);
}
BENCHMARK(observerUpdate)->Name("observer_update")->Unit(benchmark::kMicrosecond);

/// Bringing the estimate forward and its standard deviations, once per tracker tick.
void estimatorEstimate(benchmark::State& state) {
  const RobotParameters robot = benchmarkRobot();
  const std::vector<SensorFrame> motion = shuttle(robot);
  TwoStateFilter filter(robot, {});
  for (std::int64_t tick = 1; tick <= 400; ++tick) {
    SensorFrame frame = motion[static_cast<std::size_t>(tick - 1)];
    frame.imu_count = tick;
    frame.time = frame.imu_time = simTimeFromNs(tick * 2'500'000);
    filter.update(frame, tick < 3);
  }
  for (auto _ : state) benchmark::DoNotOptimize(filter.estimate(simTimeFromNs(1'001'000'000)));
}
BENCHMARK(estimatorEstimate)->Name("estimator_estimate")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ballbot
