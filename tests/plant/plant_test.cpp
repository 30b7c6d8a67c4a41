#include "plant/plant.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "model/frames.hpp"
#include "model/reduced_dynamics.hpp"
#include "support/busy_command.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(Plant, StandHoldsUntilTheReleaseAndNoLonger) {
  for (const char* structure : {"full", "reduced_wheels"}) {
    Plant plant(plantConfig("full", {"plant.fidelity.multibody=" + std::string(structure),
                                     "initial={pitch_deg: 5, release_s: 0.0213}"}));
    const TruthFrame start = plant.truth();
    plant.advanceTo(ms(21.3), busyCommand());
    EXPECT_EQ(plant.truth().state, start.state);
    EXPECT_EQ(plant.truth().joint_angle, start.joint_angle);
    EXPECT_GT((plant.truth().motor_angle - start.motor_angle).norm(), 1e-4);  // motors are alive
    plant.advanceTo(ms(21.4), busyCommand());
    EXPECT_NE(plant.truth().state, start.state);
  }
}

TEST(Plant, SensorsFeelGravityAtTheStartAndAtRest) {
  const PlantConfig config =
      plantConfig("ideal", {"initial={pitch_deg: 10, roll_deg: -4, yaw_deg: 30, release_s: 0.1}"});
  Plant plant(config);
  const RobotPose& pose = config.initial.pose;
  const Matrix3 R = rotationFromYawPitchRoll(pose.yaw, pose.pitch, pose.roll);
  const Vector3 gravity = R.transpose() * Vector3(0, 0, config.robot.gravity);
  EXPECT_EQ(plant.sensors().imu_count, 1);
  EXPECT_LT((plant.sensors().accel_B - gravity).norm(), 1e-12);
  plant.advanceTo(ms(50), ActuatorCommand{});
  EXPECT_EQ(plant.sensors().imu_count, 21);
  EXPECT_EQ(plant.sensors().imu_time, ms(50));
  EXPECT_LT((plant.sensors().accel_B - gravity).norm(), 1e-12);
  EXPECT_EQ(plant.sensors().gyro_WB_B, Vector3::Zero());
}

TEST(Plant, StaysAtItsEquilibrium) {
  const RobotParameters robot = exampleRobot();
  const Equilibrium e = findEquilibrium(ReducedDynamics(robot), robot.nominal_arm);
  PlantConfig config = plantConfig("ideal");
  config.initial.pose.pitch = e.x[kPitch];
  config.initial.pose.roll = e.x[kRoll];
  Plant plant(config);
  ActuatorCommand command;
  command.torque = e.tau;
  plant.advanceTo(ms(100), command);
  EXPECT_LT((plant.truth().state - e.x).norm(), 1e-9);
}

// At rest an IMU average is gravity; in motion it is the mean of R^T (a + g) at the IMU, here from
// second differences of its true position.
TEST(Plant, ImuAveragesSpecificForceAndRate) {
  for (const char* structure : {"full", "reduced_wheels"}) {
    PlantConfig config =
        plantConfig("full", {"plant.fidelity.multibody=" + std::string(structure),
                             "plant.fidelity.sensors=perfect", "plant.substep_us=50",
                             "plant.drive_period_us=2500", "initial={pitch_deg: 8, yaw_deg: 50}"});
    config.robot.p_BI_B = Vector3(0.2, -0.1, 0.4);
    Plant plant(config);
    const ActuatorCommand command = busyCommand();
    plant.advanceTo(ms(197.5), command);

    const double h = 50e-6;
    std::vector<Vector3> p, rate;
    std::vector<Matrix3> R;
    const auto note = [&] {
      const StateVector& x = plant.truth().state;
      R.push_back(rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]));
      p.push_back(Vector3(x[kBallX], x[kBallY], 0) + R.back() * config.robot.p_BI_B);
      rate.push_back(x.segment<3>(kPositionDim + kOmegaX));
    };
    note();
    for (int n = 1; n <= 50; ++n) {
      plant.advanceTo(ms(197.5) + n * SimDuration{50'000}, command);
      note();
    }
    ASSERT_EQ(plant.sensors().imu_time, ms(200));
    // Trapezoids over the inner nodes, where central differences exist; the ends by extrapolation.
    const auto specificForce = [&](int n) -> Vector3 {
      const Vector3 a = (p[n + 1] - 2 * p[n] + p[n - 1]) / (h * h);
      return R[n].transpose() * (a + Vector3(0, 0, config.robot.gravity));
    };
    Vector3 force = 0.5 * (2 * specificForce(1) - specificForce(2)) +
                    0.5 * (2 * specificForce(49) - specificForce(48));
    Vector3 gyro = 0.5 * (rate.front() + rate.back());
    for (int n = 1; n < 50; ++n) {
      force += specificForce(n);
      gyro += rate[n];
    }
    EXPECT_LT((plant.sensors().accel_B - force / 50).norm(), 1e-3);
    EXPECT_LT((plant.sensors().gyro_WB_B - gyro / 50).norm(), 1e-6);
    EXPECT_GT((plant.sensors().accel_B - R.back().transpose() * Vector3(0, 0, 9.81)).norm(), 0.1);
  }
}

TEST(Plant, PushAndPayloadActAsTheModelSays) {
  PlantConfig config = plantConfig(
      "ideal", {"environment={payload_kg: 0.8, pushes: [{body: arm_3, point_m: [0, 0, 0.35], "
                "force_N: [5, -8, 3], start_s: 0.002, duration_s: 0.001}]}",
                "initial={pitch_deg: 3, roll_deg: 2, yaw_deg: 40, release_s: 0.002}"});
  Plant plant(config);
  const ReducedDynamics model(config.robot);
  EXPECT_DOUBLE_EQ(model.robot().payload_mass, 0.8);
  plant.advanceTo(ms(2), ActuatorCommand{});
  EXPECT_EQ(plant.truth().external_force_W, Vector3(5, -8, 3));
  const PositionVector q = plant.truth().state.head<8>();
  const VelocityVector expected =
      model.acceleration(q, VelocityVector::Zero(), JointVector::Zero(), Vector3(5, -8, 3));
  plant.advanceTo(ms(2.1), ActuatorCommand{});
  const VelocityVector gained = plant.truth().state.tail<8>() / 1e-4;
  EXPECT_LT((gained - expected).norm(), 1e-5 * expected.norm());
  plant.advanceTo(ms(3), ActuatorCommand{});
  EXPECT_EQ(plant.truth().external_force_W, Vector3::Zero());
}

TEST(Plant, PushChangesNothingBeforeItsStart) {
  const std::string push =
      "environment={pushes: [{body: base, point_m: [0, 0, 0.35], force_N: [0, 20, 0], "
      "start_s: 0.0331, duration_s: 0.01}]}";
  Plant pushed(plantConfig("full", {push})), alone(plantConfig("full"));
  pushed.advanceTo(ms(33.1), busyCommand());
  alone.advanceTo(ms(33.1), busyCommand());
  EXPECT_EQ(pushed.stateDigest(), alone.stateDigest());
  pushed.advanceTo(ms(33.2), busyCommand());
  alone.advanceTo(ms(33.2), busyCommand());
  EXPECT_GT(pushed.truth().state[kPositionDim + kBallVy],
            alone.truth().state[kPositionDim + kBallVy]);
}

TEST(Plant, CommandArrivesAfterItsDelay) {
  Plant plant(plantConfig(
      "ideal", {"plant.fidelity.transport_delay=true", "plant.transport_delay_ticks=3"}));
  ActuatorCommand command;
  command.torque[4] = 1.5;
  for (int tick = 1; tick <= 5; ++tick) {
    plant.advanceTo(ms(0.4 * tick), command);
    EXPECT_EQ(plant.sensors().joint_torque[4], tick <= 3 ? 0 : 1.5) << tick;
  }
}

TEST(Plant, CutsAtDriveTicksMakeNoDifference) {
  const PlantConfig config = plantConfig("full", {"plant.substep_us=200"});
  std::vector<std::uint64_t> digests;
  for (const double step : {0.4, 2.0, 20.0}) {
    Plant plant(config);
    for (int n = 1; n * step < 40.001; ++n) plant.advanceTo(ms(n * step), busyCommand());
    digests.push_back(plant.stateDigest());
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

TEST(Plant, OtherCutsChangeTheResultOnlyByIntegrationError) {
  // Without quantisation, which makes a count of any difference, and dry friction, whose steep zero
  // crossing costs most of the accuracy.
  const PlantConfig config =
      plantConfig("full", {"plant.fidelity.sensors=perfect", "plant.fidelity.friction=false",
                           "initial={pitch_deg: 3}"});
  Plant whole(config), cut(config);
  whole.advanceTo(ms(60), busyCommand());
  for (int n = 1; n <= 200; ++n) cut.advanceTo(ms(0.3 * n), busyCommand());
  EXPECT_LT((whole.truth().state - cut.truth().state).norm(), 1e-6);
  EXPECT_EQ(whole.sensors().imu_count, cut.sensors().imu_count);
}

TEST(Plant, SavedStateContinuesBitForBitInAFreshPlant) {
  for (const char* multibody : {"full", "reduced_wheels"}) {
    for (const char* actuators : {"ideal", "series_elastic"}) {
      for (const char* contact : {"rolling", "rolling_with_spin_friction"}) {
        const PlantConfig config =
            plantConfig("full", {"plant.fidelity.multibody=" + std::string(multibody),
                                 "plant.fidelity.actuators=" + std::string(actuators),
                                 "plant.fidelity.contact=" + std::string(contact),
                                 "plant.leak_compensation=true", "initial={pitch_deg: 3}"});
        Plant original(config);
        original.advanceTo(ms(11.3), busyCommand());  // between ticks, between IMU samples
        const StateBlob blob = original.saveState();
        const SensorFrame sensors = original.sensors();
        original.advanceTo(ms(30), busyCommand());

        Plant fresh(config);
        fresh.advanceTo(ms(4), ActuatorCommand{});
        fresh.restoreState(blob);
        EXPECT_EQ(fresh.now(), ms(11.3));
        EXPECT_EQ(fresh.sensors().joint_velocity, sensors.joint_velocity);
        EXPECT_EQ(fresh.sensors().joint_torque, sensors.joint_torque);
        EXPECT_EQ(fresh.saveState(), blob);
        fresh.advanceTo(ms(30), busyCommand());
        EXPECT_EQ(fresh.saveState(), original.saveState());
        EXPECT_EQ(fresh.truth().state, original.truth().state);
        EXPECT_EQ(fresh.stateDigest(), original.stateDigest());
      }
    }
  }
}

TEST(Plant, RepeatsItselfAfterReset) {
  Plant plant(plantConfig("full", {"initial={pitch_deg: 3}"}));
  plant.advanceTo(ms(20), busyCommand());
  const std::uint64_t digest = plant.stateDigest();
  plant.reset(kSimStart);
  plant.advanceTo(ms(20), busyCommand());
  EXPECT_EQ(plant.stateDigest(), digest);
}

TEST(Plant, RefusesABlobItCannotUseAndStaysAsItIs) {
  const PlantConfig config = plantConfig("full");
  Plant plant(config);
  plant.advanceTo(ms(10), busyCommand());
  const StateBlob good = plant.saveState();
  const std::uint64_t digest = plant.stateDigest();

  StateBlob damaged = good;
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_NE(messageOf([&] { plant.restoreState(damaged); }).find("damaged"), std::string::npos);
  const StateBlob cut(good.begin(), good.end() - 9);
  EXPECT_NE(messageOf([&] { plant.restoreState(cut); }).find("header says"), std::string::npos);
  Plant other(plantConfig("full", {"plant.fidelity.multibody=reduced_wheels"}));
  const std::string text = messageOf([&] { plant.restoreState(other.saveState()); });
  EXPECT_NE(text.find("is of a plant with multibody reduced_wheels"), std::string::npos) << text;
  EXPECT_NE(text.find("this one has multibody full"), std::string::npos) << text;

  EXPECT_EQ(plant.stateDigest(), digest);
  plant.advanceTo(ms(20), busyCommand());
  Plant undisturbed(config);
  undisturbed.advanceTo(ms(20), busyCommand());
  EXPECT_EQ(plant.stateDigest(), undisturbed.stateDigest());
}

TEST(Plant, RefusesACommandThatIsNotFinite) {
  Plant plant(plantConfig("full"));
  plant.advanceTo(ms(10), busyCommand());
  const std::uint64_t digest = plant.stateDigest();
  ActuatorCommand command;
  command.velocity[4] = std::nan("");
  EXPECT_THROW(plant.advanceTo(ms(11), command), NumericalError);
  EXPECT_EQ(messageOf([&] { plant.advanceTo(ms(11), command); }),
            "command at 0.010000 s: velocity_arm2 is nan, must be finite");
  EXPECT_EQ(plant.stateDigest(), digest);
}

TEST(Plant, SaysWhenItsStateIsNotFiniteAnyMore) {
  for (const char* structure : {"full", "reduced_wheels"}) {
    Plant plant(plantConfig("ideal", {"plant.fidelity.multibody=" + std::string(structure)}));
    const StateBlob before = plant.saveState();
    ActuatorCommand command;
    command.torque.setConstant(1e300);
    EXPECT_THROW(plant.advanceTo(ms(100), command), NumericalError);
    plant.restoreState(before);
    plant.advanceTo(ms(1), ActuatorCommand{});
    EXPECT_TRUE(plant.truth().state.allFinite());
  }
}

TEST(Plant, RefusesToGoBack) {
  Plant plant(plantConfig("ideal"));
  plant.advanceTo(ms(10), ActuatorCommand{});
  EXPECT_EQ(messageOf([&] { plant.advanceTo(ms(10), ActuatorCommand{}); }),
            "plant: asked to advance from 0.010000 s to 0.010000 s, must be later");
}

TEST(Plant, PerfectSensorsSayTheTruth) {
  Plant plant(plantConfig("full", {"plant.fidelity.sensors=perfect", "initial={pitch_deg: 3}"}));
  plant.advanceTo(ms(20.1), busyCommand());
  const SensorFrame& s = plant.sensors();
  const TruthFrame& t = plant.truth();
  EXPECT_EQ(s.time, ms(20.1));
  EXPECT_EQ(s.joint_angle, t.joint_angle);
  EXPECT_EQ(s.motor_angle, t.motor_angle);
  EXPECT_EQ(s.joint_velocity, t.joint_velocity);
  EXPECT_EQ(s.joint_torque, t.joint_torque);
}

TEST(Plant, EndEffectorIsWhereTheModelHasIt) {
  const PlantConfig config =
      plantConfig("ideal", {"initial={pitch_deg: 3, roll_deg: 8, yaw_deg: 70}"});
  Plant plant(config);
  plant.advanceTo(ms(100), busyCommand());
  const auto e = ReducedDynamics(config.robot).endEffector(plant.truth().state);
  EXPECT_LT((plant.truth().p_WE - e.p_WE).norm(), 1e-12);
  const Eigen::Vector4d& q = plant.truth().quat_WE;
  EXPECT_LT((Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix() - e.R_WE).norm(), 1e-12);
}

/// Upright and symmetric about the vertical, so that equal wheel torques turn it on the spot.
PlantConfig spinningTop(double friction) {
  PlantConfig config = plantConfig(
      "ideal", {"plant.fidelity.contact=rolling_with_spin_friction", "initial={arm_rad: [0, 0, 0]}",
                "plant.spin_friction={torque_Nm: " + std::to_string(friction) +
                    ", smoothing_rad_per_s: 0.05}"});
  return config;
}

/// Angular momentum about the vertical, and the ball's spin, of such a motion.
struct Spin {
  double momentum, ball;
};
Spin spinOf(const PlantConfig& config, const TruthFrame& t) {
  const RobotParameters& r = config.robot;
  const double w = t.state[kPositionDim + kOmegaZ];
  const double d_z = r.wheelAxle(0).z();
  // dphi = -(r/r_w) d_z (s - w)
  const double s = w - r.wheels.radius / r.ball.radius * t.joint_velocity[0] / d_z;
  double inertia = r.baseWithWheels().I_LLcm_L(2, 2);
  for (const ArmLink& link : r.arm) inertia += link.inertia.I_LLcm_L(2, 2);
  const double arm = r.arm[0].inertia.I_LLcm_L(2, 2) + r.arm[1].inertia.I_LLcm_L(2, 2) +
                     r.arm[2].inertia.I_LLcm_L(2, 2);
  return {r.ball.inertia * s + inertia * w + arm * t.joint_velocity[3] +
              3 * r.wheels.spin_inertia * d_z * (d_z * w + t.joint_velocity[0]),
          s};
}

TEST(Plant, SpinFrictionIsTheOnlyTorqueAboutTheVertical) {
  for (const double friction : {0.0, 0.4}) {
    const PlantConfig config = spinningTop(friction);
    Plant plant(config);
    ActuatorCommand command;
    command.torque.head<3>().setConstant(0.3);
    double impulse = 0;
    const auto torque = [&] {
      return -friction * std::tanh(spinOf(config, plant.truth()).ball / 0.05);
    };
    for (int n = 1; n <= 1000; ++n) {
      const double before = torque();
      plant.advanceTo(ms(0.4 * n), command);
      impulse += 4e-4 * 0.5 * (before + torque());
    }
    const Spin spin = spinOf(config, plant.truth());
    EXPECT_GT(std::abs(spin.ball), 0.1);
    EXPECT_NEAR(spin.momentum, impulse, 1e-5);
    if (friction == 0) {
      EXPECT_NEAR(spin.momentum, 0, 1e-12);
    }
  }
}

TEST(Plant, YawIsContinuousOverManyTurns) {
  const PlantConfig config = plantConfig("ideal", {"initial={arm_rad: [0, 0, 0], yaw_deg: 170}"});
  Plant plant(config);
  ActuatorCommand command;
  command.torque.head<3>().setConstant(-0.5);
  double last = plant.truth().state[kYaw], turned = 0;
  for (int n = 1; n <= 100; ++n) {
    const double rate_before = plant.truth().state[kPositionDim + kOmegaZ];
    plant.advanceTo(ms(20.0 * n), command);
    const double rate = plant.truth().state[kPositionDim + kOmegaZ];
    EXPECT_NEAR(plant.truth().state[kYaw] - last, 0.02 * 0.5 * (rate + rate_before), 1e-6);
    turned += plant.truth().state[kYaw] - last;
    last = plant.truth().state[kYaw];
  }
  EXPECT_GT(std::abs(turned), 4 * M_PI);
}

}  // namespace
}  // namespace ballbot
