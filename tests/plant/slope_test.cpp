// A floor that is not level, on which the world's axes stay the floor's and gravity leans.
#include "plant/slope.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

constexpr double kAngle = 5 * kRadPerDeg, kHeading = 40 * kRadPerDeg;

TEST(Slope, GravityKeepsItsSizeAndFallsTowardsTheHeading) {
  const Vector3 g = Slope{kAngle, kHeading}.gravityInWorld(9.81);
  EXPECT_NEAR(g.norm(), 9.81, 1e-12);
  EXPECT_NEAR(std::acos(-g.z() / g.norm()), kAngle, 1e-9);
  EXPECT_NEAR(std::atan2(g.y(), g.x()), kHeading, 1e-12);
  EXPECT_EQ(Slope().gravityInWorld(9.81), Vector3(0, 0, -9.81));
}

TEST(Slope, ItsForcesAreTheChangeOfTheWholeWeight) {
  RobotParameters robot = exampleRobot();
  robot.payload_mass = 1.3;
  const Slope slope{kAngle, kHeading};
  std::vector<PointForce> forces;
  SlopeForces(robot, slope).addTo(forces);
  Vector3 sum = Vector3::Zero();
  for (const PointForce& f : forces) sum += f.force_W;
  const Vector3 level(0, 0, -robot.gravity);
  EXPECT_LT((sum - robot.totalMass() * (slope.gravityInWorld(robot.gravity) - level)).norm(), 1e-9);
  EXPECT_FALSE(SlopeForces(robot, Slope()).acts());
}

// Down a slope at a given lean, the plant accelerates as the model's robot does on a level floor
// under the same change of weights, body by body.
TEST(Slope, BothStructuresMoveAlikeOnIt) {
  const RobotParameters robot = exampleRobot();
  MultibodyOptions options;
  options.rotors = false;
  double acceleration[2];
  int n = 0;
  for (const auto structure : {MultibodyStructure::kFull, MultibodyStructure::kReducedWheels}) {
    options.structure = structure;
    const auto multibody = makeMultibody(robot, options);
    std::vector<double> y(static_cast<std::size_t>(multibody->stateDim())), ydot(y.size());
    RobotPose pose;
    pose.arm = robot.nominal_arm;
    multibody->place(pose, y.data());
    multibody->realize(y.data());
    MultibodyLoads loads;
    SlopeForces(robot, Slope{kAngle, 0}).addTo(loads.forces);
    multibody->derivative(loads, ydot.data());
    acceleration[n++] = multibody->baseAcceleration(ydot.data()).a_WK_W.x();
  }
  EXPECT_GT(std::abs(acceleration[0]), 0.1);
  EXPECT_NEAR(acceleration[0], acceleration[1], 1e-9);
}

}  // namespace
}  // namespace ballbot
