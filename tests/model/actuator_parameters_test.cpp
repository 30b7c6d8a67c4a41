#include "model/actuator_parameters.hpp"

#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

ActuatorParameters readWheel(const std::string& overridden) {
  ConfigNode tree = loadYamlFile(robotFile());
  if (!overridden.empty()) applyOverride(tree, "actuators.wheel." + overridden);
  ConfigReader in(tree);
  return readActuators(in).wheel;
}

std::string errorOf(const std::string& overridden) {
  try {
    readWheel(overridden);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(ActuatorParameters, FileHoldsTheDefaults) {
  const ActuatorParameters read = readWheel(""), defaults;
  EXPECT_EQ(read.spring_stiffness, defaults.spring_stiffness);
  EXPECT_EQ(read.torque_bandwidth, defaults.torque_bandwidth);
  EXPECT_NEAR(read.reflectedInertia(), 0.1, 1e-15);
}

// With damping 1/sqrt(2) a second-order lag has its -3 dB point at its natural frequency.
TEST(ActuatorParameters, GainsGiveTheWantedBandwidthWithTheOutputBlocked) {
  for (const double bandwidth : {20.0, 40.0, 60.0}) {
    ActuatorParameters p;
    p.torque_bandwidth = bandwidth;
    const double k = p.spring_stiffness, J = p.reflectedInertia();
    const std::complex<double> s(0, 2 * M_PI * bandwidth);
    const double gain = std::abs(
        k * (1 + p.torqueGainP()) /
        (J * s * s + (p.viscous_friction + k * p.torqueGainD()) * s + k * (1 + p.torqueGainP())));
    EXPECT_NEAR(gain, std::sqrt(0.5), 1e-12);
  }
}

TEST(ActuatorParameters, RefusesABandwidthBelowTheOpenLoop) {
  EXPECT_THAT(errorOf("torque_bandwidth_Hz=5"),
              ::testing::HasSubstr("torque_bandwidth_Hz is 5 Hz, below the 9.42 Hz that spring and "
                                   "rotor have without feedback"));
}

TEST(ActuatorParameters, RefusesADampingBelowThatOfFriction) {
  EXPECT_THAT(errorOf("viscous_friction_Nms_per_rad=60"),
              ::testing::HasSubstr("viscous friction alone gives 1.19 at 40 Hz"));
}

TEST(ActuatorParameters, RefusesStictionBelowCoulombFriction) {
  EXPECT_THAT(errorOf("static_friction_Nm=0.1"),
              ::testing::HasSubstr(
                  "static_friction_Nm is 0.1, must be at least coulomb_friction_Nm = 0.5"));
}

}  // namespace
}  // namespace ballbot
