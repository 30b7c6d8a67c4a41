// The robot and what it touches, as one plant.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "model/reduced_dynamics.hpp"
#include "plant/integrator.hpp"
#include "plant/plant.hpp"
#include "plant/plant_dynamics.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

SimTime ms(double t) { return simTimeFromNs(std::llround(1e6 * t)); }

/// The robot a centimetre in front of a door, or of a wall.
PlantConfig touching(const std::string& plant, const std::string& structure,
                     const std::string& what = "door") {
  const std::string door =
      "door: {hinge_m: [0.28, 0.7], closed_heading_deg: -90, opens: counterclockwise, "
      "inertia_kgm2: 6, damping_Nms_per_rad: 4, friction_Nm: 1, closer_stiffness_Nm_per_rad: 2}";
  const std::string wall = "wall: {foot_m: [0.28, 0], facing_deg: 180}";
  return plantConfig(plant, {"plant.fidelity.multibody=" + structure, "initial={pitch_deg: 6}",
                             "environment={" + (what == "door" ? door : wall) + "}"});
}

/// Falls towards the door with the arm held by its drives.
ActuatorCommand fallForward() {
  ActuatorCommand c;
  c.torque << 0, 0, 0, 0, -2, 2.6;
  c.position << 0, 0, 0, 0, -0.6, 2.17;
  c.stiffness << 0, 0, 0, 30, 30, 30;
  c.damping << 0, 0, 0, 1, 1, 1;
  return c;
}

const char* const kStructures[] = {"full", "reduced_wheels"};

TEST(TouchingPlant, BothStructuresOpenTheDoorAlike) {
  TruthFrame truth[2];
  for (int i = 0; i < 2; ++i) {
    Plant plant(touching("full", kStructures[i]));
    for (int n = 1; n <= 15; ++n) {
      plant.advanceTo(ms(20 * n), fallForward());
      if (plant.truth().contact_phase != ContactPhase::kNone) truth[i] = plant.truth();
    }
    ASSERT_GT(truth[i].contact_force_W.norm(), 1);
    ASSERT_GT(plant.truth().door_angle, 1e-3);
    truth[i] = plant.truth();
  }
  EXPECT_LT((truth[0].state - truth[1].state).norm(), 1e-7);
  EXPECT_NEAR(truth[0].door_angle, truth[1].door_angle, 1e-9);
  EXPECT_LT((truth[0].contact_force_W - truth[1].contact_force_W).norm(), 1e-4);
}

TEST(TouchingPlant, ContinuesFromASavedStateBitForBit) {
  for (const char* structure : kStructures) {
    for (const char* what : {"door", "wall"}) {
      const PlantConfig config = touching("full", structure, what);
      Plant original(config);
      SimTime t = kSimStart;
      while (original.truth().contact_phase == ContactPhase::kNone) {
        ASSERT_LT(t, ms(500));
        t += SimDuration{10'700'000};
        original.advanceTo(t, fallForward());
      }
      const StateBlob blob = original.saveState();
      const TruthFrame truth = original.truth();
      const SimTime end = t + SimDuration{50'000'000};
      original.advanceTo(end, fallForward());
      Plant fresh(config);
      fresh.restoreState(blob);
      EXPECT_EQ(fresh.truth().contact_force_W, truth.contact_force_W);
      EXPECT_EQ(fresh.truth().door_angle, truth.door_angle);
      fresh.advanceTo(end, fallForward());
      EXPECT_EQ(fresh.saveState(), original.saveState());
      EXPECT_EQ(fresh.truth().contact_force_W, original.truth().contact_force_W);
      EXPECT_EQ(fresh.stateDigest(), original.stateDigest());
    }
  }
}

TEST(TouchingPlant, RefusesTheStateOfAPlantWithoutADoor) {
  Plant plain(plantConfig("full"));
  Plant plant(touching("full", "full"));
  try {
    plant.restoreState(plain.saveState());
    FAIL() << "was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("this one has multibody full"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("a door"), std::string::npos);
  }
}

TEST(TouchingPlant, OutOfReachChangesNoBit) {
  Plant plain(plantConfig("full", {"initial={pitch_deg: 6}"}));
  PlantConfig far = touching("full", "full");
  far.surroundings.door->hinge << 5, 0.7;
  Plant beside(far);
  for (Plant* plant : {&plain, &beside}) plant->advanceTo(ms(100), fallForward());
  EXPECT_EQ(plain.truth().state, beside.truth().state);
  EXPECT_EQ(plain.sensors().accel_B, beside.sensors().accel_B);
}

// Without actuators the robot falls into the door. The sum of all energies may only fall, by what
// damper, friction and contact take.
TEST(TouchingPlant, CreatesNoEnergy) {
  for (const char* structure : kStructures) {
    PlantConfig config = touching("ideal", structure);
    PlantDynamics dynamics(config);
    std::vector<double> y(dynamics.dim());
    dynamics.place(config.initial.pose, y.data());
    VelocityVector nu = VelocityVector::Zero();
    nu[kBallVx] = 0.5;
    nu[kOmegaY] = 0.3;
    nu[kArmRate1] = 0.3;
    dynamics.multibody().setVelocity(nu, 0, y.data());
    dynamics.settle(y.data());
    const double start = dynamics.energy(y.data());
    double last = start;
    int touched = 0;
    RungeKutta4 rk4(dynamics.dim());
    for (int n = 0; n < 1000; ++n) {
      rk4.step(dynamics, 0, 4e-4, y.data());
      dynamics.project(y.data());
      dynamics.settle(y.data());
      const double now = dynamics.energy(y.data());
      ASSERT_LT(now, last + 2e-5) << n;
      last = std::min(last, now);
      touched += dynamics.touch(y.data()).phase != ContactPhase::kNone;
    }
    EXPECT_GT(touched, 50);
    EXPECT_LT(last, start - 1e-3);
  }
}

// The contact acts on the robot as a force on its end-effector does in the reduced model.
TEST(TouchingPlant, AcceleratesAsUnderThatForceOnTheEndEffector) {
  for (const char* structure : kStructures) {
    PlantConfig config = touching("ideal", structure, "wall");
    const ReducedDynamics model(config.robot);
    StateVector x = StateVector::Zero();
    x[kPitch] = 0.05;
    x.segment<3>(kArm1) << 0.2, -0.6, 2.1;
    x.tail<kVelocityDim>() << 0.2, -0.1, 0.1, 0.2, -0.1, 0.3, -0.2, 0.4;
    const auto ee = model.endEffector(x);
    config.surroundings.wall->p_WF.x() = ee.p_WE.x() - 2e-3;
    PlantDynamics dynamics(config);
    std::vector<double> y(dynamics.dim()), ydot(dynamics.dim());
    dynamics.place({0, 0, 0, x[kPitch], 0, x.segment<3>(kArm1)}, y.data());
    dynamics.multibody().setVelocity(x.tail<kVelocityDim>(), 0, y.data());
    dynamics.settle(y.data());
    const Touch touch = dynamics.touch(y.data());
    EXPECT_LT((touch.foot_W - ee.p_WE).norm(), 3e-3);
    ASSERT_GT(touch.force_W.norm(), 5);
    dynamics.derivative(0, y.data(), ydot.data());
    const VelocityVector expected = model.acceleration(
        x.head<kPositionDim>(), x.tail<kVelocityDim>(), JointVector::Zero(), touch.force_W);
    const Vector3 arm = dynamics.multibody().jointAcceleration(ydot.data()).joint.tail<3>();
    EXPECT_LT((arm - expected.tail<3>()).norm(), 1e-9 * expected.norm());
    EXPECT_LT(
        (dynamics.multibody().baseAcceleration(ydot.data()).a_WK_W.head<2>() - expected.head<2>())
            .norm(),
        1e-9 * expected.norm());
  }
}

}  // namespace
}  // namespace ballbot
