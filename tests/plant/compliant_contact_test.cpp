#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "plant/floor_contact.hpp"
#include "plant/integrator.hpp"
#include "plant/plant.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

MultibodyOptions onFloor(const FloorContactParameters& floor, bool rotors) {
  MultibodyOptions o;
  o.rotors = rotors;
  o.floor = floor;
  return o;
}

/// The floor without anything that takes energy away.
FloorContactParameters lossless() {
  FloorContactParameters p;
  p.dissipation = p.friction = 0;
  return p;
}

/// Arm straight up: everything that has mass lies symmetrically about the vertical.
RobotParameters uprightRobot() {
  RobotParameters robot = exampleRobot();
  robot.base.p_LLcm_L.head<2>().setZero();
  return robot;
}

double weightOf(const RobotParameters& robot) {
  double mass = robot.ball.mass + robot.baseWithWheels().mass;
  for (int j = 0; j + 1 < kArmJointCount; ++j) mass += robot.arm[j].inertia.mass;
  return robot.gravity * (mass + robot.lastLinkWithPayload().mass);
}

class Freely final : public OdeSystem {
 public:
  explicit Freely(Multibody& robot) : robot_(robot) {}
  void derivative(double, const double* y, double* ydot) override {
    robot_.realize(y);
    robot_.derivative(loads, ydot);
  }
  MultibodyLoads loads;

 private:
  Multibody& robot_;
};

TEST(FloorContact, RollingFeelsNoFrictionAndSlidingAllOfIt) {
  FloorContactParameters p;
  const FloorContact floor(p, 0.125, 0.02);
  const double height = 0.1245;
  const Vector3 v(0.3, -0.2, 0);
  const Vector3 rolling(-v.y() / height, v.x() / height, 0);
  const FloorLoad none = floor.load(height, v, rolling, 0);
  EXPECT_LT(none.force.head<2>().norm(), 1e-12);
  EXPECT_NEAR(none.force.z(), p.stiffness * std::pow(0.125 - height, 1.5), 1e-6);
  const FloorLoad sliding = floor.load(height, v, Vector3::Zero(), 0);
  EXPECT_NEAR(sliding.force.head<2>().norm(), p.friction * sliding.force.z(), 1e-9);
  EXPECT_LT(sliding.force.head<2>().dot(v.head<2>()), 0);
  EXPECT_EQ(floor.load(0.126, v, rolling, 0).force, Vector3::Zero()) << "in the air";
}

TEST(FloorContact, SpinIsBrakedByATorqueThatGoesWithTheLoad) {
  const FloorContact floor(FloorContactParameters{}, 0.125, 0.02);
  const FloorLoad load = floor.load(0.1245, Vector3::Zero(), {0, 0, 3}, 0.0016);
  EXPECT_NEAR(load.torque.z(), -0.0016 * load.force.z(), 1e-12);
}

TEST(CompliantContact, StandsAtTheDepthThatHertzGives) {
  const RobotParameters robot = uprightRobot();
  const FloorContactParameters p;
  for (const bool rotors : {false, true}) {
    const auto plant = makeMultibody(robot, onFloor(p, rotors));
    std::vector<double> y(plant->stateDim()), ydot(y.size());
    RobotPose upright;
    plant->place(upright, y.data());
    plant->realize(y.data());
    const double depth = std::pow(weightOf(robot) / p.stiffness, 2.0 / 3.0);
    EXPECT_NEAR(robot.ball.radius - plant->base().p_WK.z(), depth, 1e-12);
    EXPECT_NEAR(depth, 5e-4, 5e-5) << "half a millimetre, as its documentation says";
    plant->derivative({}, ydot.data());
    for (const double rate : ydot) EXPECT_NEAR(rate, 0, 1e-8) << "it stands still";
  }
}

TEST(CompliantContact, RollingOnTheBallHoldsAlongTheMotion) {
  const auto plant = makeMultibody(exampleRobot(), onFloor(FloorContactParameters{}, true));
  for (int i = 0; i < 50; ++i) {
    const RandomMotion motion = randomMotion(i);
    const std::vector<double> y = stateOf(*plant, motion);
    std::vector<double> ydot(y.size()), moved(y.size());
    plant->realize(y.data());
    EXPECT_LT(plant->wheelSlip().norm(), 1e-13);
    plant->derivative(motion.loads, ydot.data());
    const auto slipAt = [&](double dt) {
      for (std::size_t k = 0; k < y.size(); ++k) moved[k] = y[k] + dt * ydot[k];
      plant->realize(moved.data());
      return plant->wheelSlip();
    };
    const double dt = 1e-6;
    EXPECT_LT(((slipAt(dt) - slipAt(-dt)) / (2 * dt)).norm(), 1e-4) << "state " << i;
  }
}

TEST(CompliantContact, KeepsItsEnergyWhereNothingTakesItAway) {
  for (const bool rotors : {false, true}) {
    const auto plant = makeMultibody(exampleRobot(), onFloor(lossless(), rotors));
    RandomMotion motion = randomMotion(1);
    motion.nu *= 0.5;
    std::vector<double> y = stateOf(*plant, motion);
    y[2] += 0.002;  // lets it drop
    Freely system(*plant);
    ErrorControlledStep integrator(plant->stateDim(), 1e-9);
    plant->realize(y.data());
    const double start = plant->energy();
    double lowest = 1;
    for (int i = 0; i < 150; ++i) {
      integrator.step(system, 0, 1e-3, y.data());
      plant->project(y.data());
      plant->realize(y.data());
      EXPECT_NEAR(plant->energy(), start, 1e-5 * start);
      lowest = std::min(lowest, y[2]);
    }
    EXPECT_LT(lowest, exampleRobot().ball.radius - 5e-4) << "it did press into the floor";
  }
}

TEST(CompliantContact, FrictionAndDampingOnlyTakeEnergy) {
  const auto plant = makeMultibody(exampleRobot(), onFloor(FloorContactParameters{}, true));
  std::vector<double> y = stateOf(*plant, randomMotion(2));
  y[2] += 0.002;
  Freely system(*plant);
  ErrorControlledStep integrator(plant->stateDim(), 1e-7);
  plant->realize(y.data());
  const double start = plant->energy();
  double last = start;
  for (int i = 0; i < 100; ++i) {
    integrator.step(system, 0, 1e-3, y.data());
    plant->project(y.data());
    plant->realize(y.data());
    EXPECT_LT(plant->energy(), last + 1e-6 * start);
    last = plant->energy();
  }
  EXPECT_LT(last, start);
}

// m d(dx)/dt = -k x^(3/2) (1 + d dx) has a first integral, whatever k and m: speeds before and
// after an impact obey  d (v0 + v1) = ln((1 + d v0) / (1 - d v1)),  d = 3/2 c.
TEST(CompliantContact, ReboundsAsTheFirstIntegralOfTheImpactSays) {
  const RobotParameters robot = uprightRobot();
  FloorContactParameters p;
  p.stiffness = 1e12;  // so short an impact that weight has no say in it
  p.dissipation = 0.5;
  const auto plant = makeMultibody(robot, onFloor(p, false));
  std::vector<double> y(plant->stateDim());
  plant->place({}, y.data());
  const double drop = 0.005;
  y[2] = robot.ball.radius + drop;
  Freely system(*plant);
  ErrorControlledStep integrator(plant->stateDim(), 1e-9);
  double highest = 0;
  bool touched = false;
  for (int i = 0; i < 700; ++i) {
    integrator.step(system, 0, 1e-4, y.data());
    plant->project(y.data());
    touched = touched || y[2] < robot.ball.radius;
    if (touched) highest = std::max(highest, y[2] - robot.ball.radius);
  }
  const double d = 1.5 * p.dissipation, v0 = std::sqrt(2 * robot.gravity * drop);
  double low = 0, high = v0;
  while (high - low > 1e-12) {
    const double v1 = 0.5 * (low + high);
    (d * (v0 + v1) > std::log((1 + d * v0) / (1 - d * v1)) ? low : high) = v1;
  }
  EXPECT_NEAR(std::sqrt(2 * robot.gravity * highest) / v0, low / v0, 0.003);
  EXPECT_LT(low / v0, 0.9) << "the damping is to be seen";
}

/// How far apart two robots are after a tenth of a second under the same loads [m, rad].
double apartFromRolling(const FloorContactParameters& p) {
  const RobotParameters robot = exampleRobot();
  const auto rigid = makeMultibody(robot, multibodyOptions(MultibodyStructure::kFull, true, true));
  const auto compliant = makeMultibody(robot, onFloor(p, true));
  RandomMotion motion = randomMotion(4);
  motion.nu *= 0.2;
  motion.loads.joint_torque *= 0.2;
  motion.loads.rotor_torque *= 0.2;
  motion.loads.forces.clear();
  const auto end = [&](Multibody& plant, auto integrator) {
    std::vector<double> y = stateOf(plant, motion);
    Freely system(plant);
    system.loads = motion.loads;
    for (int i = 0; i < 250; ++i) {
      integrator.step(system, 0, 4e-4, y.data());
      plant.project(y.data());
    }
    plant.realize(y.data());
    return plant.base();
  };
  const BaseMotion a = end(*rigid, RungeKutta4(rigid->stateDim()));
  const BaseMotion b = end(*compliant, ErrorControlledStep(compliant->stateDim(), 1e-6));
  return (a.p_WK - b.p_WK).head<2>().norm() + (a.R_WB - b.R_WB).norm();
}

TEST(CompliantContact, BecomesRollingAsTheFloorBecomesHardAndRough) {
  FloorContactParameters soft, hard;
  hard.stiffness = 64 * soft.stiffness;  // a sixteenth of the depth
  hard.slip_velocity = soft.slip_velocity / 4;
  const double soft_apart = apartFromRolling(soft), hard_apart = apartFromRolling(hard);
  EXPECT_LT(soft_apart, 5e-3);
  EXPECT_GT(soft_apart, 1e-6) << "two models, not one";
  EXPECT_LT(hard_apart, soft_apart / 3);
}

TEST(CompliantContact, ThePlantHasItAsALevelOfFidelity) {
  const std::vector<std::string> level = {"plant.fidelity.contact=compliant",
                                          "initial={pitch_deg: 2}"};
  Plant plant(plantConfig("full", level)), again(plantConfig("full", level));
  ActuatorCommand command;
  command.torque << 0.4, -0.3, 0.2, 0.5, -2, 1;
  plant.advanceTo(simTimeFromNs(20'000'000), command);
  for (int i = 1; i <= 10; ++i) again.advanceTo(simTimeFromNs(2'000'000 * i), command);
  EXPECT_EQ(plant.stateDigest(), again.stateDigest()) << "cut into calls it is the same";
  const StateBlob saved = plant.saveState();
  plant.advanceTo(simTimeFromNs(30'000'000), command);
  Plant other(plantConfig("full", level));
  other.restoreState(saved);
  other.advanceTo(simTimeFromNs(30'000'000), command);
  EXPECT_EQ(plant.stateDigest(), other.stateDigest()) << "restored it goes on the same way";
  EXPECT_THROW(Plant(plantConfig("full")).restoreState(saved), InputError);
}

TEST(CompliantContact, NeedsWheelsThatAreBodies) {
  try {
    plantConfig("full",
                {"plant.fidelity.contact=compliant", "plant.fidelity.multibody=reduced_wheels"});
    FAIL() << "was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("compliant"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("set fidelity.multibody to full"), std::string::npos)
        << e.what();
  }
}

TEST(ErrorControlledStep, KeepsToItsToleranceOnAStiffProblem) {
  /// y' = -L (y - cos t) - sin t, whose solution from 1 is cos t.
  class Stiff final : public OdeSystem {
   public:
    void derivative(double t, const double* y, double* ydot) override {
      ydot[0] = -2e4 * (y[0] - std::cos(t)) - std::sin(t);
    }
  } system;
  ErrorControlledStep integrator(1, 1e-7);
  double y = 1;
  for (int i = 0; i < 100; ++i) integrator.step(system, 0.01 * i, 0.01, &y);
  EXPECT_NEAR(y, std::cos(1), 1e-6);
}

TEST(ErrorControlledStep, SaysWhenNoStepIsShortEnough) {
  /// y' = y^2, which leaves for infinity at t = 1.
  class BlowUp final : public OdeSystem {
   public:
    void derivative(double, const double* y, double* ydot) override { ydot[0] = y[0] * y[0]; }
  } system;
  ErrorControlledStep integrator(1, 1e-9);
  double y = 1;
  EXPECT_THROW(integrator.step(system, 0, 10, &y), NumericalError);
}

}  // namespace
}  // namespace ballbot
