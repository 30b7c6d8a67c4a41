// What the truth knows of floor and ball about the vertical, and a floor that is not everywhere the
// same.
#include "plant/added_truth.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "plant/plant.hpp"
#include "tests/plant/support/plant_fixture.hpp"

namespace ballbot {
namespace {

const char* const kFloor =
    "plant.spin_friction={torque_Nm: 0.8, smoothing_rad_per_s: 0.02, patches: ["
    "{center_m: [1, 0], radius_m: 0.5, torque_Nm: 0.2}, "
    "{center_m: [1.4, 0], radius_m: 0.2, torque_Nm: 1.5}]}";

TEST(AddedTruth, OfWherePatchesOverlapTheLastCounts) {
  const SpinFriction floor = plantConfig("full", {kFloor}).spin_friction;
  EXPECT_EQ(floor.heldAt({0, 0}), 0.8);
  EXPECT_EQ(floor.heldAt({0.6, 0}), 0.2);
  EXPECT_EQ(floor.heldAt({1.3, 0}), 1.5);
  EXPECT_EQ(floor.heldAt({1.55, 0}), 1.5);
  EXPECT_EQ(floor.heldAt({1.61, 0}), 0.8);
}

TEST(AddedTruth, ABallThatCannotSpinHasNone) {
  Plant plant(plantConfig("full", {"plant.fidelity.contact=rolling"}));
  EXPECT_TRUE(plant.added(AddedTo::kTruth).empty());
}

/// Wheels that all turn one way twist ball and base against each other.
TEST(AddedTruth, FollowsTheSpin) {
  for (const char* contact : {"rolling_with_spin_friction", "compliant"}) {
    Plant plant(plantConfig("full", {std::string("plant.fidelity.contact=") + contact,
                                     "initial={arm_rad: [0, 0, 0]}", kFloor}));
    const AddedSignals& floor = plant.added(AddedTo::kTruth);
    ASSERT_EQ(floor.list.size(), 3u);
    ActuatorCommand command;
    command.torque.head<kWheelCount>().setConstant(0.8);
    for (int ms = 1; ms <= 60; ++ms) {
      plant.advanceTo(kSimStart + SimDuration(ms * 1'000'000), command);
      const double spin = floor.values[AddedTruth::kSpinRate];
      const double held = floor.values[AddedTruth::kSpinTorqueHeld];
      EXPECT_NEAR(floor.values[AddedTruth::kSpinTorque], -held * std::tanh(spin / 0.02), 1e-12);
      EXPECT_NEAR(held, 0.8, 0.08) << contact;  // one that gives way carries its load
    }
    EXPECT_GT(floor.values[AddedTruth::kSpinRate], 0.2) << contact;
  }
}

}  // namespace
}  // namespace ballbot
