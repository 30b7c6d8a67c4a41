#include "plant/multibody.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "model/frames.hpp"
#include "model/reduced_dynamics.hpp"
#include "plant/integrator.hpp"
#include "support/plant_fixture.hpp"
#include "support/structure_a.hpp"
#include "tests/model/sliding_robot.hpp"

namespace ballbot {
namespace {

constexpr auto kFull = MultibodyStructure::kFull;
constexpr auto kReduced = MultibodyStructure::kReducedWheels;

struct Accelerations {
  Vector3 a_WK_W, alpha_WB_W;
  JointVector joints, rotors;
};

Accelerations accelerations(Multibody& robot, const RandomMotion& motion) {
  const std::vector<double> y = stateOf(robot, motion);
  std::vector<double> ydot(y.size());
  robot.realize(y.data());
  robot.derivative(motion.loads, ydot.data());
  const BaseAcceleration base = robot.baseAcceleration(ydot.data());
  const JointAcceleration joints = robot.jointAcceleration(ydot.data());
  return {base.a_WK_W, base.alpha_WB_W, joints.joint, joints.rotor};
}

double relativeDifference(const Accelerations& a, const Accelerations& b) {
  Eigen::Matrix<double, 6 + kJointCount, 1> va, vb;
  va << a.a_WK_W, a.alpha_WB_W, a.joints;
  vb << b.a_WK_W, b.alpha_WB_W, b.joints;
  return (va - vb).norm() / vb.norm();
}

TEST(Multibody, AgreesWithAFreeBallOnAFloor) {
  const RobotParameters robot = exampleRobot();
  StructureA oracle(robot);
  for (const auto structure : {kFull, kReduced}) {
    const auto plant = makeMultibody(robot, multibodyOptions(structure, false));
    for (int i = 0; i < 100; ++i) {
      const RandomMotion motion = randomMotion(i);
      const auto a = oracle.acceleration(motion.pose, motion.nu, motion.loads);
      ASSERT_LT(oracle.velocityError(), 1e-12);  // both were given the same motion
      EXPECT_LT(
          relativeDifference(accelerations(*plant, motion), {a.a_WK_W, a.alpha_WB_W, a.joints, {}}),
          1e-9)
          << "state " << i;
    }
  }
}

TEST(Multibody, WithoutRotorsAgreesWithTheReducedDynamics) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    RobotParameters robot = shape;
    robot.payload_mass = 0.7;
    const ReducedDynamics model(robot);
    for (const auto structure : {kFull, kReduced}) {
      const auto plant = makeMultibody(robot, multibodyOptions(structure, false));
      for (int i = 0; i < 100; ++i) {
        RandomMotion motion = randomMotion(i);
        const Vector3 force = motion.loads.forces.back().force_W;
        motion.loads.forces = {{kHandBody, robot.p_A3E, force}};
        PositionVector q;
        q << motion.pose.px, motion.pose.py, motion.pose.yaw, motion.pose.pitch, motion.pose.roll,
            motion.pose.arm;
        const VelocityVector expected =
            model.acceleration(q, motion.nu, motion.loads.joint_torque, force);
        const Accelerations got = accelerations(*plant, motion);
        const Matrix3 R = rotationFromYawPitchRoll(q[kYaw], q[kPitch], q[kRoll]);
        VelocityVector nu_dot;
        nu_dot << got.a_WK_W.head<2>(), R.transpose() * got.alpha_WB_W, got.joints.tail<3>();
        EXPECT_LT((nu_dot - expected).norm(), 1e-9 * expected.norm()) << "state " << i;
      }
    }
  }
}

TEST(Multibody, WheelsAndRotorsMayBeBodiesOrGyrostats) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    const RobotParameters robot = shape;
    for (const bool rotors : {false, true}) {
      for (const bool ball_spin : {false, true}) {
        const auto full = makeMultibody(robot, multibodyOptions(kFull, rotors, ball_spin));
        const auto reduced = makeMultibody(robot, multibodyOptions(kReduced, rotors, ball_spin));
        for (int i = 0; i < 30; ++i) {
          const Accelerations a = accelerations(*full, randomMotion(i));
          const Accelerations b = accelerations(*reduced, randomMotion(i));
          EXPECT_LT(relativeDifference(a, b), 1e-11);
          EXPECT_LT((a.rotors - b.rotors).norm(), 1e-11 * b.rotors.norm());
        }
      }
    }
  }
}

// Rotors held still in their carriers are part of them: the robot is then as heavy as its table
// says, whatever mass the rotors were given.
TEST(Multibody, HeldRotorsLeaveTheRobotAsItIs) {
  const RobotParameters robot = exampleRobot();
  const auto plain = makeMultibody(robot, multibodyOptions(kFull, false, true));
  for (const auto structure : {kFull, kReduced}) {
    const auto geared = makeMultibody(robot, multibodyOptions(structure, true, true));
    for (int i = 0; i < 20; ++i) {
      // Base and ball turn as one, the arm stands still in the base: no rotor turns in its carrier.
      RandomMotion motion = randomMotion(i);
      const RobotPose& p = motion.pose;
      const Vector3 w_W =
          rotationFromYawPitchRoll(p.yaw, p.pitch, p.roll) * motion.nu.segment<3>(kOmegaX);
      motion.nu.head<2>() = robot.ball.radius * Eigen::Vector2d(w_W.y(), -w_W.x());
      motion.nu.tail<3>().setZero();
      motion.ball_spin = w_W.z();

      const std::vector<double> y = stateOf(*geared, motion);
      std::vector<double> ydot(y.size());
      geared->realize(y.data());
      ASSERT_LT(geared->joints().rotor_velocity.norm(), 1e-12);
      const auto rotorAcceleration = [&](const JointVector& torque) {
        motion.loads.rotor_torque = torque;
        geared->derivative(motion.loads, ydot.data());
        return geared->jointAcceleration(ydot.data()).rotor;
      };
      // Affine in the torques; solve for those that hold.
      const JointVector at_zero = rotorAcceleration(JointVector::Zero());
      Eigen::Matrix<double, kJointCount, kJointCount> slope;
      for (int j = 0; j < kJointCount; ++j) {
        slope.col(j) = rotorAcceleration(JointVector::Unit(j)) - at_zero;
      }
      const JointVector holding = -slope.partialPivLu().solve(at_zero);
      EXPECT_LT(relativeDifference(
                    [&] {
                      motion.loads.rotor_torque = holding;
                      return accelerations(*geared, motion);
                    }(),
                    accelerations(*plain, motion)),
                1e-9);
    }
  }
}

/// The multibody alone, under constant loads.
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

// Slip velocity differenced along ydot: what a wrong acceleration-level constraint would show.
TEST(Multibody, RollingHoldsAlongTheMotion) {
  const RobotParameters robot = exampleRobot();
  for (const bool ball_spin : {false, true}) {
    const auto plant = makeMultibody(robot, multibodyOptions(kFull, true, ball_spin));
    for (int i = 0; i < 50; ++i) {
      const RandomMotion motion = randomMotion(i);
      const std::vector<double> y = stateOf(*plant, motion);
      std::vector<double> ydot(y.size()), moved(y.size());
      plant->realize(y.data());
      EXPECT_LT(plant->wheelSlip().norm(), 1e-14);
      plant->derivative(motion.loads, ydot.data());
      const auto slipAt = [&](double dt) {
        for (std::size_t k = 0; k < y.size(); ++k) moved[k] = y[k] + dt * ydot[k];
        plant->realize(moved.data());
        return plant->wheelSlip();
      };
      const double dt = 1e-5;
      const Vector3 slip_rate = (slipAt(dt) - slipAt(-dt)) / (2 * dt);
      EXPECT_LT(slip_rate.norm(), 1e-6) << "state " << i;  // accelerations are of order 10 to 100
    }
  }
}

TEST(Multibody, ProjectionRemovesSlipAndNothingElse) {
  const auto plant = makeMultibody(exampleRobot(), multibodyOptions(kFull, true));
  const std::vector<double> y = stateOf(*plant, randomMotion(3));
  std::vector<double> same = y;
  plant->project(same.data());
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(same[i], y[i], 1e-14);

  std::vector<double> off = y;
  for (double& value : off) value *= 1 + 1e-6;
  plant->project(off.data());
  plant->realize(off.data());
  EXPECT_LT(plant->wheelSlip().norm(), 1e-14);
}

double energyDrift(MultibodyStructure structure, bool rotors, double duration, double step) {
  const auto plant = makeMultibody(exampleRobot(), multibodyOptions(structure, rotors));
  RandomMotion motion = randomMotion(1);
  motion.nu *= 0.5;
  std::vector<double> y = stateOf(*plant, motion);
  Freely system(*plant);
  RungeKutta4 rk4(plant->stateDim());
  plant->realize(y.data());
  const double start = plant->energy();
  double worst = 0;
  const int steps = static_cast<int>(duration / step + 0.5);
  for (int i = 0; i < steps; ++i) {
    rk4.step(system, 0, step, y.data());
    plant->project(y.data());
    plant->realize(y.data());
    worst = std::max(worst, std::abs(plant->energy() - start));
  }
  return worst / start;
}

TEST(Multibody, ReducedStructureKeepsItsEnergy) {
  EXPECT_LT(energyDrift(kReduced, true, 10, 4e-4), 1e-6);
}

TEST(Multibody, FullStructureKeepsItsEnergy) {
  EXPECT_LT(energyDrift(kFull, false, 10, 4e-4), 1e-6);
}

TEST(Multibody, EnergyGrowsByTheWorkOfTheLoads) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    const RobotParameters robot = shape;
    for (const auto structure : {kFull, kReduced}) {
      const auto plant = makeMultibody(robot, multibodyOptions(structure, true, true));
      const RandomMotion motion = randomMotion(5);
      std::vector<double> y = stateOf(*plant, motion);
      Freely system(*plant);
      system.loads = motion.loads;
      system.loads.ball_spin_torque = 0.3;
      RungeKutta4 rk4(plant->stateDim());
      const auto power = [&] {
        plant->realize(y.data());
        const JointMotion m = plant->joints();
        // Loads act between joint and carrier, and between rotor and carrier.
        double p = system.loads.joint_torque.dot(m.velocity) +
                   system.loads.rotor_torque.dot(m.rotor_velocity) + 0.3 * plant->base().ball_spin;
        for (const PointForce& f : system.loads.forces) {
          if (f.body == kBallBody) {
            const Vector3 v = plant->base().v_WK_W;
            const Vector3 w(-v.y() / robot.ball.radius, v.x() / robot.ball.radius,
                            plant->base().ball_spin);
            p += f.force_W.dot(v + w.cross(f.p_BP_B));
          } else {
            const BodyMotion b = plant->body(f.body);
            p += f.force_W.dot(b.v_WL_W + b.w_WL_W.cross(b.R_WL * f.p_BP_B));
          }
        }
        return p;
      };
      plant->realize(y.data());
      const double before = plant->energy();
      double work = 0;
      const double h = 2e-5;
      for (int i = 0; i < 500; ++i) {  // Simpson over pairs of steps
        const double p0 = power();
        rk4.step(system, 0, h, y.data());
        const double p1 = power();
        rk4.step(system, 0, h, y.data());
        work += h / 3 * (p0 + 4 * p1 + power());
      }
      plant->realize(y.data());
      EXPECT_NEAR(plant->energy() - before, work, 1e-7 * std::abs(work));
    }
  }
}

TEST(Multibody, NamesABodyWhoseInertiaIsImpossible) {
  RobotParameters robot = exampleRobot();
  robot.arm[1].inertia.I_LLcm_L = Vector3(1, 1, 3).asDiagonal();
  robot.arm[1].inertia.p_LLcm_L.setZero();
  try {
    makeMultibody(robot, multibodyOptions(kFull, true));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("inertia of arm_2"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace ballbot
