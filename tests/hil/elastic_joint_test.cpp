// The emulated stand's actuator against closed forms, since its figures are what identification is
// held against.
#include "hil/emulator/elastic_joint.hpp"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "hil/emulator/elastic_rig.hpp"
#include "hil/emulator/emulator_config.hpp"
#include "model/actuator_response.hpp"
#include "plant/series_elastic_actuator.hpp"

namespace ballbot {
namespace {

ElasticJointParameters withoutFriction() {
  ElasticJointParameters p;
  p.actuator.coulomb_friction = p.actuator.static_friction = 0;
  return p;
}

DriveCommand torque(double value) {
  DriveCommand c;
  c.torque = value;
  return c;
}

// docs/theory/actuator.md, eq. 6, from the controller's side of the house.
TEST(ElasticJoint, BlockedAndWithoutDryFrictionIsTheKnownResponse) {
  const ElasticJointParameters p = withoutFriction();
  const ActuatorResponse known(p.actuator, ElasticJoint::kTick);
  for (const double f : {5.0, 20.0, 40.0, 80.0}) {
    ElasticJoint joint(p);
    joint.setOutput(StandOutput::kBlocked);
    const double w = kTwoPi * f, h = ElasticJoint::kTick;
    const int period = static_cast<int>(std::lround(1 / (f * h)));
    std::complex<double> response = 0;
    for (int n = 0; n < 60 * period; ++n) {
      if (n >= 50 * period) {
        response += joint.springTorque() * std::polar(2.0 / (10 * period), -w * n * h);
      }
      joint.advance(h, torque(std::cos(w * n * h)));
    }
    EXPECT_LT(std::abs(response - known.blocked(w)), 0.01) << f << " Hz";
  }
}

TEST(ElasticJoint, BacklashIsTheWayFromFlankToFlank) {
  ElasticJointParameters p = withoutFriction();
  p.backlash = 0.004;
  ElasticJoint joint(p);
  joint.setOutput(StandOutput::kBlocked);
  joint.advance(2, torque(3));
  const double up = joint.motorAngle() - joint.springTorque() / p.actuator.spring_stiffness;
  joint.advance(2, torque(-3));
  const double down = joint.motorAngle() - joint.springTorque() / p.actuator.spring_stiffness;
  EXPECT_NEAR(up - down, 0.004, 1e-9);
  EXPECT_GT(joint.motorAngle(), -3 / p.actuator.spring_stiffness - 1e-3)
      << "the drive sees angles, so backlash counts as torque";
}

// While a hand turns the output, motor and spring differ by the rotor's friction and inertia.
TEST(ElasticJoint, LoadFrictionGrowsWithTheTorqueThroughTheGear) {
  ElasticJointParameters p;
  p.load_friction = 0.1;
  ElasticJoint joint(p);
  joint.setOutput(StandOutput::kTurned);
  joint.advance(1.3, torque(5));
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const double angle = joint.motorAngle();
    joint.advance(1e-3, torque(5));
    const double before = joint.motorAngle();
    joint.advance(1e-3, torque(5));
    const double needed = joint.meanMotorTorque();
    const double spring = joint.springTorque(), after = joint.motorAngle();
    joint.advance(1e-3, torque(5));
    const double v = (joint.motorAngle() - before) / 2e-3;
    const double acceleration = (after - 2 * before + angle) / 1e-6;
    if (std::abs(v) < 0.2) continue;
    const double friction =
        actuatorFriction(p.actuator, v) + 0.1 * std::abs(spring) * (v > 0 ? 1 : -1);
    worst = std::max(
        worst, std::abs(needed - spring - friction - p.actuator.reflectedInertia() * acceleration));
  }
  EXPECT_LT(worst, 0.15) << "of 1.3 N m; differences of angles over a millisecond";
  EXPECT_GT(std::abs(joint.jointAngle()), 0.02) << "it was turned";
}

TEST(ElasticJoint, NothingMovesBeforeACommandHasArrived) {
  ElasticJointParameters p;
  p.command_delay = 1.25e-3;  // rounded up to 1.3 ms
  ElasticJoint joint(p);
  joint.advance(1.3e-3, torque(3));
  EXPECT_EQ(joint.motorAngle(), 0);
  joint.advance(1e-4, torque(3));
  EXPECT_GT(joint.motorAngle(), 0);
}

TEST(ElasticJoint, AFreeOutputTurnsItsLoad) {
  ElasticJointParameters p = withoutFriction();
  p.actuator.viscous_friction = 0;
  p.load_damping = 0;
  ElasticJoint joint(p);
  joint.setOutput(StandOutput::kFree);
  joint.advance(0.5, torque(1));
  const double before = joint.jointVelocity();
  joint.advance(0.5, torque(1));
  // What leaks into the rotor: docs/theory/actuator.md, eq. 9.
  const double arrives =
      1 / (1 + p.actuator.reflectedInertia() / (p.load_inertia * (1 + p.actuator.torqueGainP())));
  EXPECT_NEAR((joint.jointVelocity() - before) / 0.5, arrives / p.load_inertia,
              0.02 * arrives / p.load_inertia);
}

TEST(ElasticRig, NoiseIsThatOfItsSeedAndSize) {
  ElasticRigOptions options;
  options.joint.motor_torque_noise = 0.1;
  options.joint.motor_angle_noise = 1e-4;
  options.output = StandOutput::kBlocked;
  ElasticRig rig(options), again(options);
  options.noise_seed = 2;
  ElasticRig other(options);
  double square = 0;
  const int count = 4000;
  for (ElasticRig* r : {&rig, &again, &other}) r->enterInitializationMode(kSimStart);
  for (int n = 0; n < count; ++n) {
    for (ElasticRig* r : {&rig, &again, &other}) {
      r->doStep(simTimeFromNs(n * 2'500'000LL), SimDuration{2'500'000}, {});
    }
    ASSERT_EQ(rig.motorTorque(2), again.motorTorque(2));
    ASSERT_NE(rig.motorTorque(2), other.motorTorque(2));
    ASSERT_NE(rig.motorTorque(2), rig.motorTorque(3));
    square += rig.motorTorque(2) * rig.motorTorque(2);
  }
  EXPECT_NEAR(std::sqrt(square / count), 0.1, 0.1 * 4 / std::sqrt(2.0 * count));
  EXPECT_EQ(rig.joint(2).motorAngle(), 0) << "noise is of the reading";
  EXPECT_THROW(rig.doStep(kSimStart, SimDuration{2'550'000}, {}), InputError);
}

TEST(ElasticRig, IsConfiguredInTheEmulatorsSection) {
  const std::string bus = "{buses: [{link: a}], rig: ";
  const auto read = [&](const std::string& rig) {
    return readEmulatorConfig(parseYaml("{emulator: " + bus + rig + "}}", "bench.yaml"));
  };
  const EmulatorConfig c =
      read("{blocked: true, elastic: {load_friction: 0.2, backlash_deg: 0.5, delay_ms: 2}}");
  ASSERT_TRUE(c.elastic_rig);
  EXPECT_DOUBLE_EQ(c.elastic_rig->joint.load_friction, 0.2);
  EXPECT_DOUBLE_EQ(c.elastic_rig->joint.backlash, 0.5 * kRadPerDeg);
  EXPECT_DOUBLE_EQ(c.elastic_rig->joint.command_delay, 2e-3);
  EXPECT_EQ(c.elastic_rig->output, StandOutput::kBlocked);
  EXPECT_FALSE(read("{}").elastic_rig);
  const EmulatorConfig plain = read("{elastic: {}}");
  EXPECT_EQ(plain.elastic_rig->joint.load_friction, 0) << "nothing that was not asked for";
  EXPECT_EQ(plain.elastic_rig->joint.backlash, 0);
  EXPECT_EQ(plain.elastic_rig->joint.command_delay, 0);
  EXPECT_EQ(plain.elastic_rig->joint.motor_torque_noise, 0);
  EXPECT_THROW(read("{elastic: {backlash: 1}}"), InputError);
  EXPECT_THROW(read("{elastic: {}, damping_ratio: 1}"), InputError) << "of the other rig";
  const auto fault = [&](const std::string& rest) {
    return read("{}, faults: [{at_cycle: 5, kind: " + rest + "}]").faults.at(0);
  };
  EXPECT_EQ(fault("tilt, value: 0.5").value, 0.5);
  EXPECT_EQ(fault("reboot, drive: 3").drive, 2);
  EXPECT_THROW(fault("tilt"), InputError) << "of no size";
}

}  // namespace
}  // namespace ballbot
