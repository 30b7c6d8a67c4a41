#include "tests/estimator/support/filter_run.hpp"

#include <cmath>

namespace ballbot::test {

FilterState truthAsFilterState(const Truth& truth) {
  FilterState x;
  x.p_WK_W = truth.motion.p_WK.head<2>();
  x.R_WB = truth.motion.R_WB;
  x.v_WK_W = truth.motion.v_WK_W.head<2>();
  x.w_WB_B = truth.mean_w_WB_B;
  x.accel_bias = truth.accel_bias;
  x.gyro_bias = truth.gyro_bias;
  x.spin = truth.mean_spin;
  return x;
}

TwoStateSettings matchedSettings() {
  TwoStateSettings s;
  s.noise.accel_inflation = 1;
  return s;
}

template <int kDim>
RunErrors play(const BasicFilterRun<kDim>& run, RejectionCounts* counts) {
  const RobotParameters robot = estimatorTestRobot();
  SimulatedSensors sensors(run.script, robot, run.noise, run.seed);
  // The motion is drawn: no drive and no gravity makes it, so its way of falling tells nothing.
  TwoStateSettings settings = run.settings;
  settings.balance.enabled = false;
  BasicTwoStateFilter<kDim> filter(run.believed, settings);
  RunErrors e;
  double tilt2 = 0, velocity2 = 0;
  int samples = 0;
  while (sensors.truth().t_s < run.seconds - 1e-9) {
    sensors.advance();
    SensorFrame frame = sensors.frame();
    if (run.disturb) run.disturb(frame, sensors.truth());
    filter.update(frame, sensors.atRest());
    const Truth& truth = sensors.truth();
    e.distance += 2.5e-3 * truth.motion.v_WK_W.norm();
    if (sensors.atRest() || truth.t_s <= run.from) continue;
    const FilterState& x = filter.state();
    const FilterState x_true = truthAsFilterState(truth);
    const BasicTangentVector<kDim> error = x_true.minus<kDim>(x);
    // The angle between the two verticals.
    const double tilt =
        ((x.R_WB.transpose() - x_true.R_WB.transpose()) * Vector3::UnitZ()).norm() / kRadPerDeg;
    const double velocity = error.template segment<2>(kTanVelocity).norm();
    tilt2 += tilt * tilt;
    velocity2 += velocity * velocity;
    e.tilt_max_deg = std::max(e.tilt_max_deg, tilt);
    e.velocity_max = std::max(e.velocity_max, velocity);
    e.nees_mean += error.dot(filter.information() * error);
    e.nis_mean += filter.nis();
    e.position_end = error.template segment<2>(kTanPosition).norm();
    e.yaw_end_deg =
        std::abs(filter.estimate(frame.time).x[kYaw] - truth.motion.yaw_pitch_roll[0]) / kRadPerDeg;
    ++samples;
    if (run.observe) run.observe(filter, truth);
  }
  e.tilt_rms_deg = std::sqrt(tilt2 / samples);
  e.velocity_rms = std::sqrt(velocity2 / samples);
  e.nees_mean /= samples;
  e.nis_mean /= samples;
  if (counts != nullptr) *counts = filter.rejections();
  return e;
}

template RunErrors play(const FilterRun&, RejectionCounts*);
template RunErrors play(const SpinFilterRun&, RejectionCounts*);

}  // namespace ballbot::test
