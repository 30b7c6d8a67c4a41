// How the wheels stand on the ball: normal forces against the change of momentum, friction against
// its law, sliding against closed forms, energy against the work of forces.
#include "plant/wheel_traction.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "model/wheel_loads.hpp"
#include "plant/added_truth.hpp"
#include "plant/plant.hpp"
#include "tests/model/sliding_robot.hpp"
#include "tests/plant/support/plant_fixture.hpp"

namespace ballbot {
namespace {

double uniform(int index, int k) {  // in (-1, 1)
  const RandomStream stream(3, "wheel_traction_test");
  return 2 * stream.uniforms(static_cast<std::uint64_t>(index), k / 4)[k % 4] - 1;
}

TractionProblem randomProblem(int index) {
  TractionProblem p;
  int k = 0;
  Matrix3 half;
  for (int i = 0; i < 9; ++i) half(i) = uniform(index, k++);
  p.A = 100 * half * half.transpose() + 800 * Matrix3::Identity();
  for (int i = 0; i < 3; ++i) {
    p.wanted[i] = 6000 * uniform(index, k++);
    p.slip[i] = 0.5 * uniform(index, k++);
    p.N_free[i] = 80 + 100 * uniform(index, k++);
    for (int j = 0; j < 3; ++j) p.N_torque(i, j) = 5 * uniform(index, k++);
  }
  p.fade_s = 1e-3;
  p.creep = 0.01;
  p.friction_lever = 0.8 * 0.064;
  return p;
}

TEST(WheelTraction, EachWheelSticksSlidesOrLifts) {
  int sliding = 0, lifted = 0;
  for (int index = 0; index < 500; ++index) {
    const TractionProblem p = randomProblem(index);
    const Vector3 lambda = solveTraction(p);
    const Vector3 N = p.normalForce(lambda);
    const Vector3 d_slip = p.A * lambda - p.wanted;
    for (int i = 0; i < 3; ++i) {
      const double held = p.friction_lever * std::max(N[i], 0.0);
      const double fading = -(p.slip[i] + p.creep * lambda[i]) / p.fade_s;
      if (std::abs(d_slip[i] - fading) < 1e-6) {
        EXPECT_LE(std::abs(lambda[i]), held + 1e-9) << index;
        continue;
      }
      ++(lambda[i] == 0 ? lifted : sliding);
      EXPECT_NEAR(std::abs(lambda[i]), held, 1e-9) << index;
      // It slides the way in which it is pushed: friction is less than what would hold it.
      EXPECT_GT((fading - d_slip[i]) * lambda[i], -1e-9) << index;
    }
  }
  EXPECT_GT(sliding, 100);
  EXPECT_GT(lifted, 20);
}

/// Whatever a fault leaves it, none carries more than it can, and those that roll do.
TEST(WheelTraction, AFaultTakesFromOneAndTheOthersAreSolvedWithIt) {
  int at_fault = 0;
  for (int index = 0; index < 500; ++index) {
    TractionProblem p = randomProblem(index);
    p.limit[1] = 0.2;
    const Vector3 lambda = solveTraction(p);
    const Vector3 N = p.normalForce(lambda), d_slip = p.A * lambda - p.wanted;
    for (int i = 0; i < 3; ++i) {
      const double held = std::min(p.limit[i], p.friction_lever * std::max(N[i], 0.0));
      EXPECT_LE(std::abs(lambda[i]), held + 1e-9) << index;
      const double fading = -(p.slip[i] + p.creep * lambda[i]) / p.fade_s;
      if (std::abs(lambda[i]) < held - 1e-9) {
        EXPECT_NEAR(d_slip[i], fading, 1e-6) << index;
      }
    }
    if (std::abs(std::abs(lambda[1]) - 0.2) < 1e-12) ++at_fault;
  }
  EXPECT_GT(at_fault, 300);
}

/// Momentum of all that stands on the ball, in W.
Vector3 momentum(const RobotParameters& robot, const Multibody& multibody) {
  Vector3 sum = Vector3::Zero();
  const auto add = [&](BodyIndex index, const BodyInertia& inertia) {
    const BodyMotion m = multibody.body(index);
    sum += inertia.mass * (m.v_WL_W + m.w_WL_W.cross(m.R_WL * inertia.p_LLcm_L));
  };
  add(kBaseBody, robot.baseWithWheels());
  add(kLink1Body, robot.arm[0].inertia);
  add(armBody(1), robot.arm[1].inertia);
  add(kHandBody, robot.lastLinkWithPayload());
  return sum;
}

TEST(WheelTraction, CarriesWhatChangesTheMomentum) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    RobotParameters robot = shape;
    robot.payload_mass = 0.7;
    for (const bool slipping : {false, true}) {
      MultibodyOptions options = multibodyOptions(MultibodyStructure::kFull, true, true);
      options.wheel_contacts = true;
      if (slipping) options.wheel_slip.emplace();
      const auto multibody = makeMultibody(robot, options);
      std::vector<double> ydot(multibody->stateDim());
      for (int index = 0; index < 30; ++index) {
        const RandomMotion m = randomMotion(index);
        const std::vector<double> y = stateOf(*multibody, m);
        multibody->realize(y.data());
        multibody->derivative(m.loads, ydot.data());
        const WheelContacts contacts = multibody->wheelContacts();
        Vector3 carried = Vector3::Zero();
        const Matrix3 R_WB = multibody->base().R_WB;
        for (int i = 0; i < kWheelCount; ++i) {
          const Vector3 c = robot.wheelCentre(i).normalized();
          carried += R_WB * (contacts.normal_force[i] * c +
                             contacts.traction[i] * c.cross(robot.wheelAxle(i)));
        }
        Vector3 expected(0, 0, robot.gravity * (robot.totalMass() - robot.ball.mass));
        for (const PointForce& f : m.loads.forces) {
          if (f.body != kBallBody) expected -= f.force_W;
        }
        const double h = 1e-6;
        std::vector<double> moved(y.size());
        for (const double sign : {1.0, -1.0}) {
          for (std::size_t k = 0; k < y.size(); ++k) moved[k] = y[k] + sign * h * ydot[k];
          multibody->realize(moved.data());
          expected += sign / (2 * h) * momentum(robot, *multibody);
        }
        EXPECT_LT((carried - expected).norm(), 1e-5 * (1 + expected.norm())) << index;
      }
    }
  }
}

/// The controller's model of the same, at the plant's acceleration.
TEST(WheelTraction, IsThatOfTheModelWhileNothingSlips) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    RobotParameters robot = shape;
    robot.payload_mass = 0.7;
    MultibodyOptions options = multibodyOptions(MultibodyStructure::kFull, false);
    options.wheel_contacts = true;
    const auto multibody = makeMultibody(robot, options);
    const WheelLoadModel model(robot);
    std::vector<double> ydot(multibody->stateDim());
    for (int index = 0; index < 30; ++index) {
      RandomMotion m = randomMotion(index);
      m.ball_spin = 0;
      const std::vector<double> y = stateOf(*multibody, m);
      multibody->realize(y.data());
      multibody->derivative(m.loads, ydot.data());
      const WheelContacts contacts = multibody->wheelContacts();
      StateVector x;
      x << m.pose.px, m.pose.py, m.pose.yaw, m.pose.pitch, m.pose.roll, m.pose.arm, m.nu;
      const BaseAcceleration base = multibody->baseAcceleration(ydot.data());
      VelocityVector dnu;
      dnu << base.a_WK_W.head<2>(), multibody->base().R_WB.transpose() * base.alpha_WB_W,
          multibody->jointAcceleration(ydot.data()).joint.tail<kArmJointCount>();
      Vector3 applied = Vector3::Zero();
      for (const PointForce& f : m.loads.forces) {
        if (f.body != kBallBody) applied += f.force_W;
      }
      const WheelLoads loads = model.at(x, dnu, m.loads.joint_torque.head<3>(), applied);
      EXPECT_LT((loads.normal - contacts.normal_force).norm(), 1e-8 * contacts.normal_force.norm());
      EXPECT_LT((loads.traction - contacts.traction).norm(), 1e-8 * contacts.traction.norm());
    }
  }
}

constexpr const char* kSlipping = "plant.fidelity.wheels=slipping";

struct Wheels {
  Vector3 normal, traction, slip;
};
Wheels wheelsOf(const Plant& plant) {
  const AddedSignals& added = plant.added(AddedTo::kTruth);
  const std::vector<std::size_t> places = AddedTruth::placesOf(added);
  std::array<double, AddedTruth::kPlaces> all{};
  for (std::size_t i = 0; i < places.size(); ++i) all[places[i]] = added.values[i];
  const auto of = [&](AddedTruth::Place place) { return Vector3(&all[place]); };
  return {of(AddedTruth::kNormalForce), of(AddedTruth::kTraction), of(AddedTruth::kSlip)};
}

SimTime ms(double t) { return kSimStart + SimDuration(std::llround(t * 1e6)); }

/// Of a wheel about its own axle, against the world [rad/s].
double spinOf(const RobotParameters& robot, int wheel, const TruthFrame& truth) {
  return truth.joint_velocity[wheel] +
         robot.wheelAxle(wheel).dot(truth.state.segment<3>(kPositionDim + kOmegaX));
}

/// All wheels turned one way turn the base about the vertical and press no wheel harder.
TEST(WheelTraction, SlidesFromWhatFrictionHoldsOn) {
  const std::vector<std::string> settings = {
      "plant.fidelity.multibody=full", kSlipping, "plant.wheel_contact={friction: 0.3}",
      "initial={arm_rad: [0, 0, 0]}", "plant.fidelity.contact=rolling"};
  const PlantConfig config = plantConfig("ideal", settings);
  const RobotParameters& robot = config.robot;
  const double carried = robot.gravity * (robot.totalMass() - robot.ball.mass);
  const double N = carried / (3 * std::cos(robot.wheels.contact_zenith));
  const double held = 0.3 * N * robot.wheels.radius;  // 2.0 N m
  for (const double share : {0.9, 1.3}) {
    Plant plant(config);
    ActuatorCommand command;
    command.torque.head<3>().setConstant(share * held);
    plant.advanceTo(ms(4), command);
    const Wheels early = wheelsOf(plant);
    Vector3 spin;
    for (int i = 0; i < 3; ++i) spin[i] = spinOf(robot, i, plant.truth());
    plant.advanceTo(ms(8), command);
    const Wheels late = wheelsOf(plant);
    // Without a word from the arm each carries a third, but for where its mass is.
    EXPECT_NEAR(late.normal.sum() / 3, N, 0.01 * N);
    for (int i = 0; i < 3; ++i) {
      if (share < 1) {
        EXPECT_NEAR(late.slip[i], -config.wheel_contact.creep * late.traction[i], 2e-5);
        EXPECT_LT(std::abs(late.traction[i]), 0.3 * late.normal[i]);
        continue;
      }
      EXPECT_NEAR(std::abs(late.traction[i]), 0.3 * late.normal[i], 1e-9);
      EXPECT_GT(late.slip[i], early.slip[i] + 0.05);
      // The wheel has what torque friction leaves.
      const double left = share * held - 0.3 * late.normal[i] * robot.wheels.radius;
      const double gain = left / robot.wheels.spin_inertia * 4e-3;
      EXPECT_NEAR(spinOf(robot, i, plant.truth()) - spin[i], gain, 0.02 * gain) << i;
    }
  }
}

TEST(WheelTraction, EnergyIsWhatTorquesGiveAndSlidingTakes) {
  const RobotParameters robot = exampleRobot();
  MultibodyOptions options = multibodyOptions(MultibodyStructure::kFull, false);
  options.wheel_slip = WheelContactParameters{0.2, 5e-5, false};
  const auto multibody = makeMultibody(robot, options);
  RobotPose pose;
  pose.pitch = 0.05;
  std::vector<double> y(multibody->stateDim()), ydot(y.size()), mid(y.size());
  multibody->place(pose, y.data());
  MultibodyLoads loads;
  loads.joint_torque << 3, -2, 1, 0, 0, 0;
  multibody->realize(y.data());
  const double before = multibody->energy();
  double work = 0, taken = 0;
  const double h = 1e-5;
  for (int k = 0; k < 20'000; ++k) {  // midpoint rule
    multibody->realize(y.data());
    multibody->derivative(loads, ydot.data());
    for (std::size_t i = 0; i < y.size(); ++i) mid[i] = y[i] + 0.5 * h * ydot[i];
    multibody->realize(mid.data());
    multibody->derivative(loads, ydot.data());
    const WheelContacts c = multibody->wheelContacts();
    work += h * loads.joint_torque.dot(multibody->joints().velocity);
    taken -= h * c.traction.dot(c.slip);
    EXPECT_GE(-c.traction.dot(c.slip), -1e-3) << k;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * ydot[i];
  }
  multibody->realize(y.data());
  EXPECT_GT(taken, 1);
  EXPECT_NEAR(multibody->energy() - before, work - taken, 1e-5 * work);
}

ActuatorCommand rough(int tick) {
  ActuatorCommand command;
  for (int i = 0; i < kJointCount; ++i) command.torque[i] = 8 * uniform(tick / 25, i);
  return command;
}

TEST(WheelTraction, ASavedSlipGoesOnBitForBit) {
  const PlantConfig config = plantConfig("full", {kSlipping, "plant.wheel_contact.friction=0.15"});
  Plant plant(config), other(config);
  for (int tick = 1; tick <= 400; ++tick) {
    const SimTime t = ms(0.4 * tick);
    plant.advanceTo(t, rough(tick));
    if (tick % 40 == 17) {
      other.restoreState(plant.saveState());
    } else if (tick > 17) {
      other.advanceTo(t, rough(tick));
    }
    if (tick < 17) continue;
    ASSERT_EQ(plant.stateDigest(), other.stateDigest()) << tick;
    ASSERT_EQ(plant.added(AddedTo::kTruth).values, other.added(AddedTo::kTruth).values) << tick;
  }
  EXPECT_GT(wheelsOf(plant).slip.norm(), 0.01);
}

TEST(WheelTraction, ToRecordThemChangesNoMotion) {
  Plant plain(plantConfig("full"));
  Plant recorded(plantConfig("full", {"plant.wheel_contact={recorded: true}"}));
  for (int tick = 1; tick <= 100; ++tick) {
    plain.advanceTo(ms(0.4 * tick), rough(tick));
    recorded.advanceTo(ms(0.4 * tick), rough(tick));
  }
  EXPECT_EQ(plain.truth().state, recorded.truth().state);
  EXPECT_GT(wheelsOf(recorded).normal.minCoeff(), 10);
  EXPECT_LT(wheelsOf(recorded).slip.norm(), 1e-9);
}

std::string errorOf(const std::vector<std::string>& overrides) {
  try {
    plantConfig("full", overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(WheelTraction, IsRefusedWhereThereIsNone) {
  EXPECT_NE(errorOf({kSlipping, "plant.fidelity.multibody=reduced_wheels"})
                .find("set fidelity.multibody to full"),
            std::string::npos);
  EXPECT_NE(errorOf({"plant.wheel_contact={recorded: true}", "plant.fidelity.contact=compliant"})
                .find("fidelity.contact: compliant"),
            std::string::npos);
}

}  // namespace
}  // namespace ballbot
