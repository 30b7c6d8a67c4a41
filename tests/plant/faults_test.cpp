#include "plant/faults.hpp"

#include <cmath>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "model/frames.hpp"
#include "model/omniwheel_kinematics.hpp"
#include "plant/plant.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

SimTime ms(double t) { return simTimeFromNs(std::llround(1e6 * t)); }

ActuatorCommand turning() {
  ActuatorCommand c;
  c.torque << 0.4, -0.3, 0.2, 0.5, -2, 1;
  c.position << 0, 0, 0, 0, -0.6, 2.17;
  c.stiffness.tail<3>().setConstant(8);
  c.damping.tail<3>().setConstant(0.6);
  return c;
}

/// Steps a plant without and one with faults side by side.
void compare(const std::string& faults, double until_ms,
             const std::function<void(double t_ms, const Plant& clean, const Plant& faulty)>& see) {
  Plant clean(plantConfig("full")), faulty(plantConfig("full", {"plant.faults=" + faults}));
  for (int k = 1; 0.4 * k < until_ms + 0.2; ++k) {
    const double t = std::round(4.0 * k) / 10;  // multiples of 0.4 that compare as they read
    clean.advanceTo(ms(t), turning());
    faulty.advanceTo(ms(t), turning());
    see(t, clean, faulty);
  }
}

std::string errorOf(const std::vector<std::string>& overrides) {
  try {
    plantConfig("full", overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Faults, AnImuGapHoldsSamplesBackAndNothingElse) {
  compare("[{kind: imu_gap, start_s: 0.02, duration_s: 0.05}]", 100,
          [](double t, const Plant& clean, const Plant& faulty) {
            const bool gap = t >= 20 && t < 70;
            if (gap) {
              EXPECT_EQ(faulty.sensors().imu_time, ms(17.5)) << t;
            } else {
              EXPECT_EQ(faulty.sensors().imu_count, clean.sensors().imu_count) << t;
              EXPECT_EQ(faulty.sensors().gyro_WB_B, clean.sensors().gyro_WB_B) << t;
            }
            EXPECT_EQ(faulty.sensors().joint_angle, clean.sensors().joint_angle);
            EXPECT_EQ(faulty.truth().joint_torque, clean.truth().joint_torque);
          });
}

TEST(Faults, AStuckEncoderRepeatsItsLastAngle) {
  double held = 0;
  compare("[{kind: encoder_stuck, joint: wheel_2, start_s: 0.03, duration_s: 0.03}]", 90,
          [&](double t, const Plant& clean, const Plant& faulty) {
            if (t <= 30) held = clean.sensors().joint_angle[1];
            JointVector expected = clean.sensors().joint_angle;
            JointVector expected_rate = clean.sensors().joint_velocity;
            if (t >= 30 && t < 60) {
              expected[1] = held;
              expected_rate[1] = 0;
            }
            EXPECT_EQ(faulty.sensors().joint_angle, expected) << t;
            EXPECT_EQ(faulty.sensors().joint_velocity, expected_rate) << t;
            // The drive reads its own encoder: the robot moves as if nothing were wrong.
            EXPECT_LT((faulty.truth().state - clean.truth().state).norm(), 1e-9);
          });
  EXPECT_NE(held, 0);
}

TEST(Faults, SpikesHaveTheirSizeAndTheirShare) {
  const double gyro_sigma = 1.2e-4 / std::sqrt(2.5e-3);
  std::int64_t last_count = 0;
  int samples = 0, spoiled = 0;
  compare(
      "[{kind: spikes, signal: gyro, start_s: 0.1, duration_s: 10, size_sigma: 50, share: 0.2}]",
      600, [&](double t, const Plant& clean, const Plant& faulty) {
        EXPECT_EQ(faulty.sensors().accel_B, clean.sensors().accel_B);
        const double off = (faulty.sensors().gyro_WB_B - clean.sensors().gyro_WB_B).norm();
        if (t < 100) {
          EXPECT_EQ(off, 0);
          return;
        }
        if (clean.sensors().imu_count == last_count) return;
        last_count = clean.sensors().imu_count;
        ++samples;
        if (off == 0) return;
        ++spoiled;
        EXPECT_NEAR(off, 50 * gyro_sigma, 1e-12);
      });
  // Binomial: four standard deviations.
  EXPECT_NEAR(spoiled, 0.2 * samples, 4 * std::sqrt(0.16 * samples));
}

/// How far the wheels' rates are from those of rolling [rad/s].
Vector3 slipRate(const PlantConfig& config, const TruthFrame& truth) {
  const OmniwheelKinematics kinematics(config.robot);
  const StateVector& x = truth.state;
  const Matrix3 R = rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]);
  const Vector3 ball = R.transpose() * OmniwheelKinematics::rollingAngularVelocity(
                                           x[kPositionDim + kBallVx], x[kPositionDim + kBallVy],
                                           config.robot.ball.radius);
  return truth.joint_velocity.head<3>() -
         kinematics.wheelRates(ball, x.segment<3>(kPositionDim + kOmegaX));
}

TEST(Faults, ASlippingWheelTurnsAgainstItsTractionAloneAndGripsAgain) {
  const PlantConfig config = plantConfig(
      "ideal", {"plant.fidelity.multibody=full",
                "plant.faults=[{kind: wheel_slip, joint: wheel_1, start_s: 0.02, duration_s: 0.01, "
                "traction_Nm: 0.5}]"});
  Plant plant(config);
  ActuatorCommand command;
  command.torque[0] = 3;
  plant.advanceTo(ms(20), command);
  EXPECT_LT(slipRate(config, plant.truth()).norm(), 1e-9);
  const double before = plant.truth().joint_velocity[0];
  plant.advanceTo(ms(29.6), command);
  // Spin of the wheel alone, from the torque that is left; the robot under it hardly moves.
  const double expected = (3 - 0.5) / config.robot.wheels.spin_inertia * 9.6e-3;
  EXPECT_NEAR(plant.truth().joint_velocity[0] - before, expected, 0.05 * expected);
  const Vector3 slip = slipRate(config, plant.truth());
  EXPECT_NEAR(slip[0], expected, 0.05 * expected);
  EXPECT_LT(slip.tail<2>().norm(), 1e-9);  // the others roll
  command.torque.setZero();
  plant.advanceTo(ms(31.2), command);
  EXPECT_LT(slipRate(config, plant.truth()).norm(), 1e-9);
}

TEST(Faults, ADeadDriveGivesNothingAndTheOthersDoNotCare) {
  const std::string fault =
      "plant.faults=[{kind: drive_dead, joint: wheel_2, start_s: 0.01, "
      "duration_s: 0.02}]";
  Plant healthy(plantConfig("ideal", {})), plant(plantConfig("ideal", {fault}));
  ActuatorCommand command, without;
  command.torque << 1, -1, 0.5, 2, 3, 1;
  without = command;
  without.torque[1] = 0;
  plant.advanceTo(ms(10), command);
  healthy.advanceTo(ms(10), command);
  EXPECT_EQ(plant.truth().joint_torque, healthy.truth().joint_torque);
  plant.advanceTo(ms(20), command);
  healthy.advanceTo(ms(20), without);
  EXPECT_EQ(plant.truth().joint_torque[1], 0);
  EXPECT_EQ(plant.truth().state, healthy.truth().state) << "as if none were asked for";
  plant.advanceTo(ms(30.4), command);
  EXPECT_NE(plant.truth().joint_torque[1], 0);
}

TEST(Faults, FrictionOfASlippingWheelTakesEnergyAndGivesNone) {
  const PlantConfig config = plantConfig(
      "ideal", {"plant.fidelity.multibody=full", "initial={pitch_deg: 4, roll_deg: -3}",
                "plant.faults=[{kind: wheel_slip, joint: wheel_2, start_s: 0, duration_s: 10, "
                "traction_Nm: 0.02}]"});
  // No motor torque: what the base loses in height becomes motion, less what friction takes.
  MultibodyOptions options;
  options.rotors = false;
  const auto robot = makeMultibody(config.robot, options);
  robot->limitTraction(FaultInjector(config.faults, config.sensors, 1).traction(ms(1)));
  std::vector<double> y(static_cast<std::size_t>(robot->stateDim())), ydot(y.size());
  robot->place(config.initial.pose, y.data());
  const double h = 1e-5;
  double energy = 0;
  for (int k = 0; k < 20'000; ++k) {
    robot->realize(y.data());
    const double now = robot->energy();
    if (k > 0) {
      EXPECT_LT(now, energy + 1e-6);  // Euler's own error, h^2
    }
    energy = now;
    robot->derivative(MultibodyLoads{}, ydot.data());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * ydot[i];
  }
}

const char* const kAllFaults =
    "plant.faults=[{kind: imu_gap, start_s: 0.02, duration_s: 0.02},"
    "{kind: encoder_stuck, joint: wheel_2, start_s: 0.025, duration_s: 0.02},"
    "{kind: spikes, signal: joint_angle, joint: arm_1, start_s: 0.01, duration_s: 0.1, share: 0.5},"
    "{kind: wheel_slip, joint: wheel_3, start_s: 0.03, duration_s: 0.02, traction_Nm: 0.1}]";
const char* const kCapture = "plant.motion_capture={period_ms: 7, delay_ms: 20}";

TEST(Faults, ASavedStateContinuesBitForBitInTheMiddleOfThem) {
  const PlantConfig config = plantConfig("full", {kAllFaults, kCapture});
  Plant plant(config), other(config);
  plant.advanceTo(ms(36), turning());
  other.restoreState(plant.saveState());
  EXPECT_EQ(other.sensors().joint_angle, plant.sensors().joint_angle);
  EXPECT_EQ(other.sensors().imu_count, plant.sensors().imu_count);
  for (double t = 36.4; t < 100; t += 0.4) {
    plant.advanceTo(ms(t), turning());
    other.advanceTo(ms(t), turning());
    ASSERT_EQ(other.sensors().joint_angle, plant.sensors().joint_angle) << t;
    ASSERT_EQ(other.sensors().imu_count, plant.sensors().imu_count) << t;
    ASSERT_EQ(other.sensors().pose_W, plant.sensors().pose_W) << t;
    ASSERT_EQ(other.stateDigest(), plant.stateDigest()) << t;
  }
}

TEST(Faults, ItMakesNoDifferenceHowTimeIsCut) {
  const PlantConfig config = plantConfig("full", {kAllFaults, kCapture});
  Plant fine(config), coarse(config);
  for (double t = 0.4; t < 80.2; t += 0.4) fine.advanceTo(ms(t), turning());
  for (double t = 16; t < 81; t += 16) coarse.advanceTo(ms(t), turning());
  EXPECT_EQ(fine.stateDigest(), coarse.stateDigest());
  EXPECT_EQ(fine.sensors().joint_angle, coarse.sensors().joint_angle);
  EXPECT_EQ(fine.sensors().pose_W, coarse.sensors().pose_W);
}

TEST(Faults, AreRefusedInWords) {
  EXPECT_NE(errorOf({"plant.faults=[{kind: gremlin, start_s: 1, duration_s: 1}]"})
                .find("kind is 'gremlin'"),
            std::string::npos);
  EXPECT_NE(
      errorOf({"plant.fidelity.multibody=reduced_wheels",
               "plant.faults=[{kind: wheel_slip, joint: wheel_1, start_s: 1, duration_s: 1}]"})
          .find("wheels must be bodies"),
      std::string::npos);
  EXPECT_NE(errorOf({"plant.faults=[{kind: wheel_slip, joint: arm_1, start_s: 1, duration_s: 1}]"})
                .find("joint is 'arm_1'"),
            std::string::npos);
}

TEST(MotionCapture, SaysWhereTheRobotWasADelayAgo) {
  Plant plant(
      plantConfig("full", {"plant.motion_capture={period_ms: 5, delay_ms: 30, position_noise_m: 0, "
                           "yaw_noise_deg: 0}",
                           "initial={yaw_deg: 20, pitch_deg: 3}"}));
  std::map<SimTime, Vector3> pose;
  for (double t = 0; t < 150; t += 5) {
    if (t > 0) plant.advanceTo(ms(t), turning());
    const StateVector& x = plant.truth().state;
    pose[ms(t)] << x[kBallX], x[kBallY], x[kYaw];
    const SensorFrame& frame = plant.sensors();
    EXPECT_EQ(frame.pose_count, t < 30 ? 0 : std::lround((t - 30) / 5) + 1);
    if (t < 30) continue;
    EXPECT_EQ(frame.pose_time, ms(t - 30));
    EXPECT_EQ(frame.pose_W, pose[ms(t - 30)]);
  }
}

}  // namespace
}  // namespace ballbot
