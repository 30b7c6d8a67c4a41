#include "hil/identify/torque_response.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "hil/identify/drive_loop.hpp"

namespace ballbot {
namespace {

TEST(TorqueResponse, BandwidthIsWhereTheGainHasFallenByThreeDecibels) {
  for (const double d : {0.3, 0.7071, 1.2}) {
    const TorqueResponse r{2, 200, d, 0.001};
    EXPECT_NEAR(std::abs(r.at(r.bandwidth_Hz())), std::sqrt(0.5), 1e-9);
  }
  const TorqueResponse first{1, 200, 0, 0};
  EXPECT_NEAR(std::abs(first.at(first.bandwidth_Hz())), std::sqrt(0.5), 1e-9);
}

// A first order between a hold and a sampler is b/(z - a) exactly, with a = e^(-w T).
TEST(TorqueResponse, SampledFirstOrderIsTheKnownDigitalFilter) {
  const double period = 0.0025;
  const TorqueResponse r{1, 150, 0, 0};
  const double a = std::exp(-150 * period);
  for (const double f : {1.0, 30.0, 100.0, 190.0}) {
    const std::complex<double> z = std::polar(1.0, kTwoPi * f * period);
    EXPECT_LT(std::abs(r.sampledAt(f, period) - (1 - a) / (z - a)), 0.01) << f;
  }
}

TEST(TorqueResponse, AFitFindsWhatMadeThePoints) {
  const double period = 0.0025;
  const TorqueResponse truth{2, 180, 0.5, 0.0012};
  std::vector<ResponsePoint> points;
  for (double f = 2; f < 150; f *= 1.2) points.push_back({f, truth.sampledAt(f, period)});
  const TorqueResponse found = fitTorqueResponse(points, 2, period);
  EXPECT_NEAR(found.natural_frequency, 180, 1e-3);
  EXPECT_NEAR(found.damping_ratio, 0.5, 1e-5);
  EXPECT_NEAR(found.delay, 0.0012, 1e-7);
  EXPECT_LT(found.residual, 1e-6);
  EXPECT_THROW(fitTorqueResponse({{1, 1.0}}, 2, period), NumericalError);
}

// Its own delay apart, a stiff drive is a first order: the gain of an ideal loop over a lag.
class Loop : public ::testing::Test {
 protected:
  Loop() {
    balance << 0.1, 350, 0.2, 0.3, 0.5, 0.08, 0.002;
    loop << std::log(18), 0.1, 4e-4, 1.2e-3;
  }
  BalanceVector balance;
  LoopVector loop;
};

TEST_F(Loop, MotorTorqueIsWhatRotorAndSpringNeed) {
  const DriveLoop drive(balance, loop, 350);
  for (const double f : {1.0, 20.0, 150.0}) {
    const Complex s(0, kTwoPi * f);
    const Complex needed = (0.1 * s * s + 0.5 * s + 350.0) * drive.deflection(f);
    EXPECT_LT(std::abs(needed - drive.motorTorque(f)), 1e-9 * std::abs(needed)) << f;
  }
}

// Friction is a torque on the rotor: what the motor does against it and what is left of it move
// spring and rotor.
TEST_F(Loop, FrictionIsBalancedByMotorSpringAndRotor) {
  const DriveLoop drive(balance, loop, 350);
  for (const double f : {1.0, 20.0, 150.0}) {
    const Complex s(0, kTwoPi * f);
    const Complex deflection = -1.0 / drive.impedance(f);
    const Complex needed = (0.1 * s * s + 0.5 * s + 350.0) * deflection;
    EXPECT_LT(std::abs(drive.againstFriction(f) - 1.0 - needed), 1e-9) << f;
  }
}

TEST_F(Loop, BandwidthIsWhereTheShownTorqueHasFallenByThreeDecibels) {
  const DriveLoop drive(balance, loop, 350);
  EXPECT_NEAR(std::abs(drive.shown(drive.bandwidth_Hz())), std::sqrt(0.5), 1e-9);
  EXPECT_LT(std::abs(drive.shown(1.01 * drive.bandwidth_Hz())), std::sqrt(0.5));
}

}  // namespace
}  // namespace ballbot
