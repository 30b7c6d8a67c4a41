#include "estimator/two_state_settings.hpp"

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {

void TwoStateSettings::describe(ConfigVisitor& v) {
  describeOwn(v);
  SharedSettings::describe(v);
}

void TwoStateSettings::describeOwn(ConfigVisitor& v) {
  v.section(may("noise", "of the sensors and of the random walks, one standard deviation"),
            [&](ConfigVisitor& in) { noise.describe(in); });
  v.section(may("initial", "one standard deviation of what is known before any measurement"),
            [&](ConfigVisitor& in) { initial.describe(in); });
  v.section(may("gate", "what the filter does not believe"),
            [&](ConfigVisitor& in) { gate.describe(in); });
  v.section(may("balance", "tilt from the way the robot falls"),
            [&](ConfigVisitor& in) { balance.describe(in); });
  v.section(may("spin", "of the ball about the vertical, which the floor holds by friction alone"),
            [&](ConfigVisitor& in) { spin.describe(in); });
  v.section(may("external_pose", "use of poses that an outside system measures; off without it"),
            [&](ConfigVisitor& in) {
              use_external_pose = true;
              pose.describe(in);
            });
  v.integer(may("iterations", "per update; one is not enough"), iterations, {2, 10});
  v.duration(may("imu_wait_ms", "a sample of the IMU that is later than this is gone without"),
             imu_wait, {0, 15});
  v.vector(may("initial_tilt_error_deg",
               "laid on pitch and roll at the release, unknown to the covariance: to study"),
           initial_tilt_error, {-45, 45}, kRadPerDeg);
}

TwoStateSettings TwoStateSettings::read(ConfigReader& in) {
  TwoStateSettings s;
  readDescribed(in, s);
  return s;
}

}  // namespace ballbot
