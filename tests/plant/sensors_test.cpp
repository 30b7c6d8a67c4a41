#include "plant/sensors.hpp"

#include <gtest/gtest.h>

#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

TEST(Imu, NoiseFollowsItsAllanVariance) {
  ImuParameters p;
  p.gyro_noise = 1.2e-4;
  p.gyro_bias_walk = 4e-3;  // strong, so that both slopes show in short averages
  p.accel_noise = 1.2e-3;
  p.accel_bias_walk = 5e-2;
  p.gyro_resolution = p.accel_resolution = 0;
  Imu imu(p, true, 11);
  const double T = toSeconds(p.period);
  const int count = 120000;
  std::vector<Vector3> gyro, accel;
  for (int n = 0; n < count; ++n) {
    imu.sample(kSimStart + (n + 1) * p.period, Vector3::Zero(), Vector3::Zero());
    gyro.push_back(imu.last().gyro_WB_B);
    accel.push_back(imu.last().accel_B);
  }
  // sigma^2(tau) = N^2 / tau + K^2 tau / 3, averaged over the three axes.
  const auto allan = [&](const std::vector<Vector3>& x, int m) {
    double sum = 0;
    Vector3 previous = Vector3::Zero();
    for (int k = 0; k < count / m; ++k) {
      Vector3 mean = Vector3::Zero();
      for (int i = 0; i < m; ++i) mean += x[k * m + i] / m;
      if (k > 0) sum += (mean - previous).squaredNorm();
      previous = mean;
    }
    return sum / (6.0 * (count / m - 1));
  };
  for (const int m : {1, 4, 16, 64, 256}) {
    const double tau = m * T;
    const auto expected = [&](double N, double K) { return N * N / tau + K * K * tau / 3; };
    // The estimate's own scatter, and the steps in which the bias walks (1/2 m^2).
    const double tolerance = 5 * std::sqrt(m / (1.5 * count)) + (m == 1 ? 0.03 : 0.01);
    EXPECT_NEAR(allan(gyro, m) / expected(p.gyro_noise, p.gyro_bias_walk), 1, tolerance) << m;
    EXPECT_NEAR(allan(accel, m) / expected(p.accel_noise, p.accel_bias_walk), 1, tolerance) << m;
  }
}

TEST(Imu, TurnOnBiasHasItsSpreadOverSeeds) {
  ImuParameters p;
  p.gyro_noise = p.accel_noise = p.gyro_resolution = p.accel_resolution = 0;
  double gyro = 0, accel = 0;
  const int seeds = 2000;
  for (int seed = 0; seed < seeds; ++seed) {
    Imu imu(p, true, static_cast<std::uint64_t>(seed));
    imu.sample(kSimStart, Vector3::Zero(), Vector3::Zero());
    gyro += imu.last().gyro_WB_B.squaredNorm() / 3;
    accel += imu.last().accel_B.squaredNorm() / 3;
  }
  EXPECT_NEAR(std::sqrt(gyro / seeds), p.gyro_turn_on_bias, 0.05 * p.gyro_turn_on_bias);
  EXPECT_NEAR(std::sqrt(accel / seeds), p.accel_turn_on_bias, 0.05 * p.accel_turn_on_bias);
}

TEST(Imu, OutputsAreWholeQuanta) {
  ImuParameters p;
  Imu imu(p, true, 3);
  for (int n = 0; n < 100; ++n) {
    imu.sample(kSimStart, Vector3(0.1, 9.7, -0.3), Vector3(0.2, -0.1, 0.4));
    for (int i = 0; i < 3; ++i) {
      const double gyro = imu.last().gyro_WB_B[i] / p.gyro_resolution;
      const double accel = imu.last().accel_B[i] / p.accel_resolution;
      EXPECT_NEAR(gyro, std::round(gyro), 1e-9);
      EXPECT_NEAR(accel, std::round(accel), 1e-9);
    }
  }
}

TEST(Imu, PerfectOneSaysWhatIsTrue) {
  Imu imu(ImuParameters{}, false, 3);
  const Vector3 f(0.1, 9.7, -0.3), w(0.2, -0.1, 0.4);
  imu.sample(simTimeFromNs(2'500'000), f, w);
  EXPECT_EQ(imu.last().accel_B, f);
  EXPECT_EQ(imu.last().gyro_WB_B, w);
  EXPECT_EQ(imu.last().count, 1);
  EXPECT_EQ(imu.last().time, simTimeFromNs(2'500'000));
}

TEST(JointEncoders, AreOffByHalfACountAtMost) {
  const EncoderParameters p = plantConfig("full").sensors.encoders;
  const JointEncoders encoders(p, false, SimDuration{400'000});
  for (int n = -200; n < 200; ++n) {
    JointMotion m;
    m.angle.setConstant(1.7e-4 * n);
    m.rotor_angle.setConstant(3.1e-6 * n);
    const double joint = encoders.jointAngle(m)[0], motor = encoders.motorAngle(m)[0];
    EXPECT_LE(std::abs(joint - m.angle[0]), 0.5001 * p.joint_resolution);
    EXPECT_LE(std::abs(motor - m.rotor_angle[0]), 0.5001 * p.motor_resolution);
    EXPECT_NEAR(joint / p.joint_resolution, std::round(joint / p.joint_resolution), 1e-9);
  }
}

TEST(JointEncoders, VelocityIsRightOnAverageAndAsNoisyAsCountsMakeIt) {
  const EncoderParameters p = plantConfig("full").sensors.encoders;
  const double T = 4e-4, rate = 0.7123;
  JointEncoders encoders(p, false, SimDuration{400'000});
  JointMotion m;
  encoders.reset(m);
  double sum = 0, sum_squared = 0;
  const int settle = 500, count = 20000;
  for (int n = 1; n <= settle + count; ++n) {
    m.angle.setConstant(rate * n * T);
    m.rotor_angle = m.angle;
    encoders.tick(m);
    if (n <= settle) continue;
    const double error = encoders.readings().joint_velocity[2] - rate;
    sum += error;
    sum_squared += error * error;
  }
  EXPECT_NEAR(sum / count, 0, 1e-3);
  // Rounding errors of variance q^2/12, differenced and low-passed by share a:
  // variance (q/T)^2 / 12 * 2 a^2 / (2 - a).
  const double a = 1 - std::exp(-2 * M_PI * p.joint_velocity_filter * T);
  const double predicted = p.joint_resolution / T * a * std::sqrt(2 / (2 - a) / 12);
  EXPECT_NEAR(std::sqrt(sum_squared / count), predicted, 0.2 * predicted);
}

TEST(JointEncoders, IdealOnesGiveExactRatesAtOnce) {
  JointEncoders encoders(EncoderParameters{}, true, SimDuration{400'000});
  JointMotion m;
  encoders.reset(m);
  m.angle.setConstant(0.123456789);
  m.velocity.setConstant(4.2);
  m.rotor_velocity.setConstant(-4.2);
  encoders.tick(m);
  EXPECT_EQ(encoders.readings().joint_velocity, m.velocity);
  EXPECT_EQ(encoders.readings().motor_velocity, m.rotor_velocity);
  EXPECT_EQ(encoders.jointAngle(m), m.angle);
}

}  // namespace
}  // namespace ballbot
