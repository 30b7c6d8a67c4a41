// Is the filter's covariance true? Monte Carlo over seeds; label sim.
#include <cmath>
#include <cstdio>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

/// Sum of the normalised squared error of the states that the sensors can see: all but position and
/// yaw, 13 of them.
double observableNees(const TwoStateFilter& filter, const TangentVector& error) {
  const Matrix3 R = filter.state().R_WB;
  Eigen::Matrix<double, 13, kTangentDim> pick = Eigen::Matrix<double, 13, kTangentDim>::Zero();
  pick.block<2, 3>(0, kTanAttitude) = R.topRows<2>();  // rotation about the horizontal axes of W
  pick.block<11, 11>(2, kTanVelocity).setIdentity();
  const Eigen::Matrix<double, 13, 1> e = pick * error;
  const Eigen::Matrix<double, 13, 13> P = pick * filter.covariance() * pick.transpose();
  return e.dot(Eigen::Matrix<double, 13, 1>(P.lu().solve(e)));
}

struct Consistency {
  double nees = 0;                     ///< at the end, mean over the runs; expected 16
  double nees_observable = 0;          ///< likewise; expected 13
  double nis = 0;                      ///< mean over all; expected 4
  double nis_low = 100, nis_high = 0;  ///< of all windows of 2000 updates

  bool holds() const {
    // Three standard deviations of the mean of 50 chi-squares about the expectation; NIS as in the
    // design of the filter.
    return nees > 14.3 && nees < 17.8 && nees_observable > 10.8 && nees_observable < 15.2 &&
           nis_low > 3.75 && nis_high < 4.25;
  }
};

Consistency monteCarlo(const TwoStateSettings& settings, int runs, double seconds) {
  Consistency c;
  for (int seed = 1; seed <= runs; ++seed) {
    FilterRun run;
    run.seed = static_cast<std::uint64_t>(seed);
    run.seconds = seconds;
    run.noise = whiteNoise();
    run.settings = settings;
    double window = 0, nees = 0, observable = 0;
    int in_window = 0, at_end = 0;
    run.observe = [&](const TwoStateFilter& filter, const Truth& truth) {
      window += filter.nis();
      if (++in_window == 2000) {
        c.nis_low = std::min(c.nis_low, window / in_window);
        c.nis_high = std::max(c.nis_high, window / in_window);
        window = in_window = 0;
      }
      // The last second is one sample as far as slow errors go.
      if (truth.t_s <= seconds - 1 || filter.state().R_WB.hasNaN()) return;
      const TangentVector error = truthAsFilterState(truth).minus(filter.state());
      nees += error.dot(filter.information() * error);
      observable += observableNees(filter, error);
      ++at_end;
    };
    const RunErrors e = play(run);
    c.nees += nees / at_end / runs;
    c.nees_observable += observable / at_end / runs;
    c.nis += e.nis_mean / runs;
  }
  return c;
}

TEST(EstimatorConsistency, HoldsOverFiftyRuns) {
  const Consistency c = monteCarlo(matchedSettings(), 50, 15.5);
  RecordProperty("nees", std::to_string(c.nees));
  EXPECT_TRUE(c.holds()) << "nees " << c.nees << ", observable " << c.nees_observable << ", nis "
                         << c.nis << " [" << c.nis_low << ", " << c.nis_high << "]";
  EXPECT_NEAR(c.nis, 4.0, 0.05);
}

TEST(EstimatorConsistency, DoesNotErodeOverAMinute) {
  const Consistency c = monteCarlo(matchedSettings(), 12, 60.5);
  EXPECT_GT(c.nees, 11);
  EXPECT_LT(c.nees, 22);
}

TEST(EstimatorConsistency, FailsForAFilterThatTrustsItsSensorsTooMuch) {
  TwoStateSettings settings = matchedSettings();
  settings.noise.gyro_density /= 2;
  settings.noise.wheel_increment /= 2;
  settings.gate.wheel_gate_sigma = settings.gate.wheel_slip_sigma = 1e6;
  settings.gate.chi_square_limit = 1e9;
  const Consistency c = monteCarlo(settings, 20, 15.5);
  EXPECT_FALSE(c.holds());
  EXPECT_GT(c.nees, 20);
  EXPECT_GT(c.nis_low, 8);
}

TEST(EstimatorConsistency, FailsForAFilterThatTrustsItsSensorsTooLittle) {
  TwoStateSettings settings = matchedSettings();
  settings.noise.accel_density *= 2;
  settings.noise.wheel_increment *= 2;
  const Consistency c = monteCarlo(settings, 20, 15.5);
  EXPECT_FALSE(c.holds());
  EXPECT_LT(c.nis_high, 2);
}

/// Means over runs and time of errors as the filter itself expects them: normalised squared error
/// per dimension, where 1 is right, less is cautious and more is too sure.
struct ErrorRatios {
  double tilt_velocity = 0, position = 0, nis = 0;
  int samples = 0;

  void add(const TwoStateFilter& filter, const Truth& truth) {
    const TangentVector error = truthAsFilterState(truth).minus(filter.state());
    const Matrix3 R = filter.state().R_WB;
    Eigen::Matrix<double, 4, kTangentDim> seen = Eigen::Matrix<double, 4, kTangentDim>::Zero();
    seen.block<2, 3>(0, kTanAttitude) = R.topRows<2>();
    seen.block<2, 2>(2, kTanVelocity).setIdentity();
    const TangentMatrix P = filter.covariance();
    const Eigen::Vector4d e = seen * error;
    const Eigen::Matrix4d P_seen = seen * P * seen.transpose();
    const Eigen::Vector2d p = error.segment<2>(kTanPosition);
    const Eigen::Matrix2d P_position = P.block<2, 2>(kTanPosition, kTanPosition);
    ++samples;
    tilt_velocity += (e.dot(Eigen::Vector4d(P_seen.llt().solve(e))) / 4 - tilt_velocity) / samples;
    position += (p.dot(Eigen::Vector2d(P_position.llt().solve(p))) / 2 - position) / samples;
    nis += (filter.nis() / filter.nisDegrees() - nis) / samples;
  }
};

TEST(EstimatorConsistency, IsCautiousByKnownFactorsWithRealEncodersAndDefaultSettings) {
  // Quantised encoders do not walk away as white increments do, and the accelerometer's noise is
  // inflated for vibration that is not there. Prints the numbers of docs/theory/estimator.md.
  ErrorRatios first, later;
  double velocity2 = 0, tilt2 = 0, yaw2 = 0;
  const int runs = 24;
  for (int seed = 1; seed <= runs; ++seed) {
    FilterRun run;
    run.seconds = 30.5;
    run.seed = static_cast<std::uint64_t>(seed);
    run.observe = [&](const TwoStateFilter& filter, const Truth& truth) {
      if (filter.stateTime().time_since_epoch().count() % 50'000'000 != 0) return;
      (truth.t_s < 2.5 ? first : later).add(filter, truth);
    };
    const RunErrors e = play(run);
    velocity2 += e.velocity_rms * e.velocity_rms / runs;
    tilt2 += e.tilt_rms_deg * e.tilt_rms_deg / runs;
    yaw2 += e.yaw_end_deg * e.yaw_end_deg / runs;
  }
  for (const auto& [name, r] : {std::pair("first 2 s", first), std::pair("later", later)}) {
    std::printf("%-10s tilt and velocity %.2f, position %.4f, innovations %.2f\n", name,
                r.tilt_velocity, r.position, r.nis);
  }
  std::printf("tilt %.3f degrees, velocity %.2f mm/s, yaw after 30 s %.2f degrees\n",
              std::sqrt(tilt2), 1e3 * std::sqrt(velocity2), std::sqrt(yaw2));
  EXPECT_GT(first.tilt_velocity, 0.25);
  EXPECT_LT(first.tilt_velocity, 0.7);
  EXPECT_GT(later.tilt_velocity, 0.2);
  EXPECT_LT(later.tilt_velocity, 0.5);
  EXPECT_GT(first.position, 0.004);
  EXPECT_LT(first.position, 0.05);
  EXPECT_GT(later.position, 0.05);
  EXPECT_LT(later.position, 0.4);
  EXPECT_GT(later.nis, 0.45);
  EXPECT_LT(later.nis, 0.55);
  EXPECT_LT(std::sqrt(tilt2), 0.1);
  EXPECT_LT(std::sqrt(velocity2), 4e-3);
  EXPECT_LT(std::sqrt(yaw2), 1.0);
}

/// Standard deviation of yaw of a robot at rest after `seconds`: Kalman filter on yaw and gyro bias
/// alone, with the wheels' yaw rate (no spin) as measurement. A second way to the same number.
double predictedYawSigma(double seconds) {
  const double h = 2.5e-3, gyro = 2.4e-3, walk = 2e-5 * std::sqrt(h);
  // Three wheels see the yaw rate with r/r_w cos(45 deg) each, 0.1 rad/s of noise on every one.
  const double wheels = 0.1 / (0.125 / 0.064 * std::sqrt(0.5) * std::sqrt(3.0));
  double yaw2 = 1e-8, cross = 0, bias2 = 1 / (1 / 9e-6 + 1 / (gyro * gyro / 200 + 1e-8));
  for (double t = 0; t < seconds; t += h) {
    // z = gyro - wheels = bias + noise, of which the gyro's part also drives yaw.
    const double s = bias2 + gyro * gyro + wheels * wheels;
    const double k_yaw = (cross - h * bias2 - h * gyro * gyro) / s, k_bias = bias2 / s;
    const double new_yaw2 =
        yaw2 - 2 * h * cross + h * h * bias2 + h * h * gyro * gyro - k_yaw * k_yaw * s;
    const double new_cross = cross - h * bias2 - k_yaw * k_bias * s;
    bias2 += walk * walk - k_bias * k_bias * s;
    yaw2 = new_yaw2;
    cross = new_cross;
  }
  return std::sqrt(yaw2);
}

TEST(EstimatorConsistency, AtRestForTenMinutesOnlyTheUnobservableGrowsAndAsPredicted) {
  const double seconds = 600;
  // White increments of wheels 2 and 3 move the estimate of vx, 9.568 rad/s per m/s each (cf. the
  // wheel rows at zero tilt); sampled every h, position walks with that times sqrt(h) per sqrt(s),
  // and with the walk of the position residual itself.
  const double velocity_sigma = 0.1 / std::hypot(9.568, 9.568);
  const double predicted_position =
      std::sqrt((velocity_sigma * velocity_sigma * 2.5e-3 + 1e-8) * seconds);
  for (const std::uint64_t seed : {1, 2}) {
    FilterRun run;
    run.script = standingStill();
    run.noise = whiteNoise();
    run.seconds = seconds;
    run.seed = seed;
    Eigen::Matrix<double, 10, 1> sigma;
    TangentVector error;
    double worst = 0;
    run.observe = [&](const TwoStateFilter& f, const Truth& t) {
      if (f.stateTime().time_since_epoch().count() % 100'000'000 != 0) return;
      sigma = f.estimate(f.stateTime()).sigma;
      error = truthAsFilterState(t).minus(f.state());
      worst = std::max(worst, (error.segment<6>(kTanAccelBias).array() /
                               f.covariance().diagonal().segment<6>(kTanAccelBias).array().sqrt())
                                  .abs()
                                  .maxCoeff());
    };
    RejectionCounts counts;
    const RunErrors e = play(run, &counts);
    EXPECT_EQ(counts.total(), 0);
    // Tilt is known to accelerometer bias over g, 0.17 degrees an axis, and stays so.
    EXPECT_LT(e.tilt_max_deg, 0.6);
    EXPECT_NEAR(sigma[2], 0.03 / 9.81, 4e-4);
    EXPECT_LT(e.velocity_max, 8e-3);
    EXPECT_LT(worst, 4.5);
    EXPECT_NEAR(sigma[0], predicted_position, 0.05 * predicted_position);
    EXPECT_NEAR(sigma[4], predictedYawSigma(seconds), 0.1 * predictedYawSigma(seconds));
    EXPECT_LT(error.segment<2>(kTanPosition).lpNorm<Eigen::Infinity>(), 4 * sigma[0]);
    EXPECT_LT(std::abs(error[kTanAttitude + 2]), 4 * sigma[4]);
  }
}

}  // namespace
}  // namespace ballbot::test
