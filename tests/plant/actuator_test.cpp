#include <gtest/gtest.h>

#include "support/joint_rig.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

using Complex = std::complex<double>;

/// The example robot's actuator with linear friction only.
ActuatorParameters linearActuator(double bandwidth) {
  ActuatorParameters p = plantConfig("full").actuators.wheel;
  p.coulomb_friction = p.static_friction = 0;
  p.torque_bandwidth = bandwidth;
  return p;
}

/// Closed form of spring torque over wanted torque, docs/theory/actuator.md eq. 6 and 7. The
/// drive's sample and hold is half a tick of delay, good to (w T)^2 / 24. load_inertia 0: output
/// blocked.
Complex closedForm(const ActuatorParameters& p, double frequency, double tick,
                   double load_inertia) {
  const Complex s(0, 2 * M_PI * frequency);
  const Complex lag = std::exp(-s * tick / 2.0) / (1.0 + s / (2 * M_PI * p.current_loop_bandwidth));
  const double Kp = p.torqueGainP(), Kd = p.torqueGainD(), k = p.spring_stiffness;
  const Complex spring = k + p.spring_damping * s;
  const Complex per_deflection = load_inertia > 0 ? 1.0 + spring / (load_inertia * s * s) : 1.0;
  return spring * lag * (1 + Kp) /
         ((p.reflectedInertia() * s * s + p.viscous_friction * s) * per_deflection + spring +
          lag * k * (Kp + Kd * s));
}

const double kFrequencies[] = {1, 2, 5, 8, 12, 20, 30, 40, 60, 90};

TEST(Actuator, FollowsItsBodePlotWithTheOutputBlocked) {
  for (const double bandwidth : {20.0, 40.0, 60.0}) {
    const ActuatorParameters p = linearActuator(bandwidth);
    for (const double f : kFrequencies) {
      JointRig rig(p, {});
      const Complex expected = closedForm(p, rig.usedFrequency(f), 4e-4, 0);
      EXPECT_LT(std::abs(rig.response(f, 1) - expected), 0.01) << bandwidth << " Hz at " << f;
    }
  }
}

TEST(Actuator, FollowsItsBodePlotOnAFreeLoad) {
  for (const double inertia : {0.044, 0.108}) {
    const ActuatorParameters p = linearActuator(40);
    for (const double f : kFrequencies) {
      JointRig::Options options;
      options.load_inertia = inertia;
      JointRig rig(p, options);
      const Complex expected = closedForm(p, rig.usedFrequency(f), 4e-4, inertia);
      EXPECT_LT(std::abs(rig.response(f, 1) - expected), 0.015) << inertia << " at " << f;
    }
  }
}

// With a fast current loop and fast drive what remains is second order, -3 dB where it was wanted.
TEST(Actuator, HasTheWantedBandwidth) {
  for (const double bandwidth : {10.0, 40.0, 80.0}) {
    ActuatorParameters p = linearActuator(bandwidth);
    p.current_loop_bandwidth = 1e5;
    p.spring_damping = 0;
    JointRig::Options options;
    options.period = SimDuration{20'000};
    JointRig rig(p, options);
    EXPECT_NEAR(std::abs(rig.response(bandwidth, 1)), std::sqrt(0.5), 0.01) << bandwidth;
  }
}

// Model sheet: the loop shows J_r / (1 + Kp) of rotor inertia to a free load.
TEST(Actuator, LeaksRotorInertiaToAFreeLoadUnlessCompensated) {
  const double load = 0.044;
  for (const double bandwidth : {20.0, 40.0, 60.0}) {
    ActuatorParameters p = linearActuator(bandwidth);
    p.viscous_friction = 1e-9;
    const double leaked = p.reflectedInertia() / (1 + p.torqueGainP());
    JointRig::Options options;
    options.load_inertia = load;
    JointRig plain(p, options);
    EXPECT_NEAR(std::abs(plain.response(1, 1)), 1 / (1 + leaked / load), 0.01);
    options.leak_compensation = true;
    JointRig compensated(p, options);
    EXPECT_NEAR(std::abs(compensated.response(1, 1)), 1, 0.02);
  }
}

TEST(Actuator, CurrentLoopIsAFirstOrderLag) {
  const ActuatorParameters p = linearActuator(40);
  SeriesElasticActuator actuator(p, true, false, true);
  actuator.demand(10, 0);
  const double tau = 1 / (2 * M_PI * p.current_loop_bandwidth);
  EXPECT_EQ(actuator.motorTorque(0), 0);
  EXPECT_NEAR(actuator.motorTorque(tau), 10 * (1 - std::exp(-1)), 1e-12);
  actuator.demand(-3, tau);  // goes on from where it was
  EXPECT_NEAR(actuator.motorTorque(0), 10 * (1 - std::exp(-1)), 1e-12);
  EXPECT_NEAR(actuator.motorTorque(50 * tau), -3, 1e-12);
}

TEST(Actuator, FrictionOpposesMotionAndHasAStribeckCurve) {
  const ActuatorParameters p = plantConfig("full").actuators.wheel;
  for (double v = -3; v <= 3; v += 0.01) {
    EXPECT_GE(actuatorFriction(p, v) * v, 0);
    EXPECT_DOUBLE_EQ(actuatorFriction(p, -v), -actuatorFriction(p, v));
  }
  EXPECT_NEAR(actuatorFriction(p, 2), p.coulomb_friction + p.viscous_friction * 2, 1e-9);
  // Well above the smoothing and below the Stribeck velocity it is the static value.
  ActuatorParameters sharp = p;
  sharp.friction_smoothing = 1e-6;
  EXPECT_NEAR(actuatorFriction(sharp, 1e-4), p.static_friction, 1e-4);
}

TEST(Actuator, SpeedLimitStopsDrivingButNotBraking) {
  ActuatorParameters p = linearActuator(40);
  p.viscous_friction = 0.01;
  JointRig::Options options;
  options.load_inertia = 0.05;
  options.speed_limit = true;
  JointRig rig(p, options);
  double fastest = 0;
  while (rig.time() < 1) {
    rig.tick(5);
    fastest = std::max(fastest, rig.motorVelocity());
  }
  EXPECT_LT(fastest, 1.1 * p.speed_limit);  // the spring may carry it a little beyond
  EXPECT_GT(rig.motorVelocity(), 0.9 * p.speed_limit);
  EXPECT_LE(rig.motorVelocity(), p.speed_limit);
  while (rig.time() < 1.5) rig.tick(-5);
  EXPECT_LT(rig.motorVelocity(), 0);

  EXPECT_EQ(torqueAtSpeed(p, p.speed_limit), 0);
  EXPECT_EQ(torqueAtSpeed(p, 1.2 * p.speed_limit), 0);
  EXPECT_DOUBLE_EQ(torqueAtSpeed(p, 0.9 * p.speed_limit), p.peak_torque);
}

// Friction is the rotor's, and an ideal actuator has no rotor: with it, the full friction of motor
// and gear would be at the joint, which a torque loop leaves a twentieth of.
TEST(Actuator, AnIdealOneGivesTheTorqueAskedFor) {
  const ActuatorParameters p = plantConfig("full").actuators.wheel;
  for (const bool friction : {false, true}) {
    SeriesElasticActuator ideal(p, friction, false, false);
    ideal.demand(1.5, 0);
    for (const double velocity : {-5.0, -1e-3, 0.0, 1e-3, 5.0}) {
      ActuatorMotion motion;
      motion.joint_velocity = velocity;
      EXPECT_EQ(ideal.torques(1e-4, motion).joint, 1.5) << velocity;
    }
  }
}

TEST(Actuator, SaturationBoundsTheMotorTorque) {
  const ActuatorParameters p = linearActuator(60);
  for (const bool saturation : {false, true}) {
    JointRig::Options options;
    options.saturation = saturation;
    JointRig rig(p, options);
    double largest = 0;
    for (int n = 0; n < 500; ++n) {
      rig.tick(n % 50 < 25 ? 10 : -10);
      largest = std::max(largest, std::abs(rig.motorTorque()));
    }
    if (saturation) {
      EXPECT_LE(largest, p.peak_torque);
    } else {
      EXPECT_GT(largest, p.peak_torque);
    }
  }
}

TEST(Actuator, DrivePullsTowardsItsSetPoints) {
  DriveCommand c;
  c.torque = 1;
  c.position = 0.5;
  c.velocity = -0.2;
  c.stiffness = 8;
  c.damping = 0.6;
  DriveReading r;
  r.joint_angle = 0.4;
  r.joint_velocity = 0.3;
  EXPECT_DOUBLE_EQ(TorqueDrive::wantedTorque(c, r), 1 + 8 * 0.1 + 0.6 * -0.5);
}

// One count of the joint encoder is k 0.025 deg = 0.15 N m. The loop must neither hunt over more
// than that nor lose its command in it, blocked or on a load, whatever its bandwidth.
TEST(Actuator, TorqueLoopIsQuietWithQuantisedEncoders) {
  PlantConfig config = plantConfig("full");
  for (const double bandwidth : {20.0, 40.0, 80.0}) {
    for (const double inertia : {0.0, 0.04}) {
      ActuatorParameters p = config.actuators.wheel;
      p.torque_bandwidth = bandwidth;
      JointRig::Options options;
      options.load_inertia = inertia;
      options.load_damping = 0.6;
      options.load_stiffness = 8;
      options.ideal_encoders = false;
      options.encoders = config.sensors.encoders;
      options.saturation = true;
      JointRig rig(p, options);
      while (rig.time() < 1) rig.tick(0.7);
      double low = 1e9, high = -1e9;
      while (rig.time() < 2) {
        rig.tick(0.7);
        low = std::min(low, rig.springTorque());
        high = std::max(high, rig.springTorque());
      }
      const double count = p.spring_stiffness * config.sensors.encoders.joint_resolution;
      EXPECT_LT(high - low, 1.5 * count) << bandwidth << " Hz, load " << inertia;
      // Friction that the proportional gain leaves, and half a count.
      const double offset = p.static_friction / (1 + p.torqueGainP()) + 0.5 * count;
      EXPECT_NEAR(0.5 * (low + high), 0.7, 1.2 * offset) << bandwidth << " Hz, load " << inertia;
    }
  }
}

}  // namespace
}  // namespace ballbot
