#include "plant/surroundings.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/config_reader.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "core/yaml_file.hpp"
#include "plant/integrator.hpp"

namespace ballbot {
namespace {

constexpr double kStep = 4e-4;  // the plant's [s]

DoorParameters plainDoor() {
  DoorParameters p;  // hinge 0.7 m to the left of the robot, leaf across its way
  p.hinge << 0.2, 0.7;
  p.closed_heading = -M_PI / 2;
  return p;
}

SurroundingsParameters withDoor(const DoorParameters& door) {
  SurroundingsParameters p;
  p.door = door;
  return p;
}

/// A point mass among the surroundings, free under a force or led along a path of its own.
class PointMass final : public OdeSystem {
 public:
  PointMass(const SurroundingsParameters& p, double mass) : surroundings(p), mass_(mass) {
    y.assign(6 + surroundings.stateDim(), 0.0);
    surroundings.place(y.data() + 6);
  }
  Surroundings::Point point(const double* state) const {
    return {Eigen::Map<const Vector3>(state), Eigen::Map<const Vector3>(state + 3)};
  }
  Surroundings::Point point() const { return point(y.data()); }
  void put(const Vector3& p_W, const Vector3& v_W) {
    Eigen::Map<Vector3>(y.data()) = p_W;
    Eigen::Map<Vector3>(y.data() + 3) = v_W;
  }
  void derivative(double, const double* state, double* ydot) override {
    const Surroundings::Point e = point(state);
    const Vector3 contact = surroundings.derivative(state + 6, e, ydot + 6);
    Eigen::Map<Vector3>{ydot} = e.v_W;
    Eigen::Map<Vector3>{ydot + 3} = (contact + force) / mass_;
  }
  void step() {
    rk4_.step(*this, 0, kStep, y.data());
    surroundings.settle(point(), y.data() + 6);
  }
  double* state() { return y.data() + 6; }
  double energy() const {
    return 0.5 * mass_ * point().v_W.squaredNorm() + surroundings.energy(y.data() + 6, point()) -
           force.dot(point().p_W);
  }
  Touch observe() const { return surroundings.observe(y.data() + 6, point()); }
  double doorAngle() const { return surroundings.door(y.data() + 6).angle; }

  Surroundings surroundings;
  Vector3 force = Vector3::Zero();
  std::vector<double> y;

 private:
  double mass_;
  RungeKutta4 rk4_{10};
};

/// A door that nobody touches.
class FreeDoor {
 public:
  FreeDoor(const DoorParameters& p, double angle, double rate) : mass_(withDoor(p), 1) {
    mass_.put({-5, 0, 1}, Vector3::Zero());
    mass_.state()[0] = angle;
    mass_.state()[1] = rate;
  }
  DoorMotion after(double seconds) {
    for (long n = std::lround(seconds / kStep); n > 0; --n) mass_.step();
    return mass_.surroundings.door(mass_.state());
  }

 private:
  PointMass mass_;
};

TEST(Door, SwingsAgainstItsDamperAsInClosedForm) {
  DoorParameters p = plainDoor();
  p.damping = 4;
  const double t = 1.2, rate = 0.8, decay = p.damping / p.inertia;
  const DoorMotion m = FreeDoor(p, 0.1, rate).after(t);
  EXPECT_NEAR(m.rate, rate * std::exp(-decay * t), 1e-12);
  EXPECT_NEAR(m.angle, 0.1 + rate / decay * (1 - std::exp(-decay * t)), 1e-12);
}

TEST(Door, OscillatesOnItsCloserAsInClosedForm) {
  DoorParameters p = plainDoor();
  p.closer_stiffness = 10;
  p.closer_torque = 1.5;
  const double omega = std::sqrt(p.closer_stiffness / p.inertia), middle = -0.15;
  const double t = 0.25 * M_PI / omega;
  const DoorMotion m = FreeDoor(p, 0.5, 0).after(t);
  const double exact_t = std::round(t / kStep) * kStep;
  EXPECT_NEAR(m.angle, middle + 0.65 * std::cos(omega * exact_t), 1e-10);
  EXPECT_NEAR(m.rate, -0.65 * omega * std::sin(omega * exact_t), 1e-10);
}

TEST(Door, DryFrictionTakesItsWorkFromTheSwing) {
  DoorParameters p = plainDoor();
  p.friction = 2;
  p.friction_smoothing = 1e-3;
  // 1/2 I w^2 = friction * angle swept, until it stops.
  const DoorMotion m = FreeDoor(p, 0, 0.5).after(3);
  EXPECT_NEAR(m.angle, 0.5 * p.inertia * 0.25 / p.friction, 1e-3);
  EXPECT_NEAR(m.rate, 0, 1e-4);
}

TEST(Door, RestsInItsFrameUnderTheCloser) {
  DoorParameters p = plainDoor();
  p.closer_torque = 3;
  p.closer_stiffness = 5;
  const DoorMotion rest = doorAtRest(p);
  EXPECT_LE(rest.angle, 0);
  EXPECT_EQ(doorAcceleration(p, rest, 0), 0);
  const DoorMotion after = FreeDoor(p, rest.angle, 0).after(1);
  EXPECT_EQ(after.angle, rest.angle);
}

TEST(Door, IsCaughtByFrameAndBufferWithoutGainingEnergy) {
  DoorParameters p = plainDoor();
  p.opening_limit = 1;
  for (const double rate : {1.0, -1.0}) {
    FreeDoor door(p, 0.5, rate);
    const double energy = doorEnergy(p, {0.5, rate});
    for (int n = 0; n < 40; ++n) {
      const DoorMotion m = door.after(0.05);
      EXPECT_GT(m.angle, -0.06);
      EXPECT_LT(m.angle, 1.06);
      EXPECT_LE(doorEnergy(p, m), energy + 1e-9);
    }
  }
}

TEST(Door, TurnsItsFrontWithTheLeafToBothSides) {
  DoorParameters p = plainDoor();
  p.width = 0.9;
  for (const bool counterclockwise : {true, false}) {
    p.counterclockwise = counterclockwise;
    p.closed_heading =
        counterclockwise ? -M_PI / 2 : M_PI / 2;  // across the way, from left or right
    const double sign = counterclockwise ? 1 : -1;
    for (const double angle : {0.0, 0.4}) {
      const Face face = doorFace(p, {angle, 1});
      // The front looks back to the robot and opens away from it.
      EXPECT_NEAR(face.R_WF(0, 2), -std::cos(angle), 1e-15);
      EXPECT_NEAR(face.R_WF(1, 2), -sign * std::sin(angle), 1e-15);
      EXPECT_NEAR((face.R_WF.transpose() * face.R_WF - Matrix3::Identity()).norm(), 0, 1e-15);
      EXPECT_NEAR(face.R_WF.determinant(), 1, 1e-15);
      const double h = 1e-6;
      const Matrix3 turn = (doorFace(p, {angle + h, 0}).R_WF - face.R_WF) / h;
      EXPECT_NEAR((turn.col(2) - face.rate * Vector3::UnitZ().cross(face.R_WF.col(2))).norm(), 0,
                  1e-5);
      // A push against the front opens it with force times lever.
      const Vector3 leaf = sign * face.R_WF.col(0);
      const Vector3 point = face.p_WF + 0.6 * leaf + Vector3(0, 0, 1);
      EXPECT_NEAR(openingTorque(p, point, -5 * face.R_WF.col(2)), 3, 1e-14);
    }
  }
}

TEST(FaceContact, HoldsAPointInStaticBalance) {
  SurroundingsParameters p;
  p.wall.emplace();
  p.wall->p_WF << 0.2, 0, 0;
  p.wall->heading = M_PI;
  PointMass mass(p, 0.5);
  mass.put({0.2 + 10 / p.contact.stiffness, 0.1, 1}, Vector3::Zero());
  mass.force << 10, 3, -4;                      // within the cone: 5 < 0.7 * 10
  for (int n = 0; n < 25000; ++n) mass.step();  // 10 s
  const Touch t = mass.observe();
  EXPECT_NEAR((t.force_W + mass.force).norm(), 0, 1e-9);
  EXPECT_EQ(t.phase, ContactPhase::kSticking);
  // It sticks and does not creep: displaced as springs are, and no further.
  EXPECT_NEAR(mass.point().p_W.x(), 0.2 + 10 / p.contact.stiffness, 1e-9);
  EXPECT_NEAR(mass.point().p_W.y(), 0.1 + 3 / p.contact.tangential_stiffness, 1e-9);
  EXPECT_NEAR(mass.point().p_W.z(), 1 - 4 / p.contact.tangential_stiffness, 1e-9);
  EXPECT_NEAR((t.foot_W - Vector3(0.2, mass.point().p_W.y(), mass.point().p_W.z())).norm(), 0,
              1e-12);
}

TEST(FaceContact, SlidesWithTheForceOfFrictionAndNoMore) {
  SurroundingsParameters p;
  p.wall.emplace();
  p.wall->heading = M_PI;
  p.wall->width = 100;
  PointMass mass(p, 0.5);
  mass.put({0, 0, 1}, Vector3::Zero());
  mass.force << 10, 9, 0;  // 9 > 0.7 * 10
  for (int n = 0; n < 2500; ++n) mass.step();
  EXPECT_EQ(mass.observe().phase, ContactPhase::kSliding);
  const Vector3 before = mass.point().v_W;
  for (int n = 0; n < 2500; ++n) mass.step();
  EXPECT_NEAR((mass.point().v_W - before).y(), (9 - 0.7 * 10) / 0.5, 1e-6);  // after 1 s
  EXPECT_NEAR((mass.observe().force_W - Vector3(-10, -7, 0)).norm(), 0, 1e-6);
}

TEST(FaceContact, NeverPullsAndStaysInTheFrictionCone) {
  ContactParameters p;
  Face face;
  face.R_WF = faceAxes(0.3);
  face.rate = 0.5;
  face.x_low = -1;
  face.x_high = 1;
  face.height = 2;
  const RandomStream stream(3, "cone");
  int touched = 0, sliding = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto a = stream.uniforms(i, 0), b = stream.uniforms(i, 1);
    const Vector3 p_F(a[0] - 0.5, 1 + a[1], 0.01 * (a[2] - 0.7));
    const Vector3 v(b[0] - 0.5, b[1] - 0.5, b[2] - 0.5);
    const Eigen::Vector2d stretch(4e-3 * (a[3] - 0.5), 4e-3 * (b[3] - 0.5));
    const Touch t = touch(p, face, face.R_WF * p_F, v, stretch);
    const Vector3 f = face.R_WF.transpose() * t.force_W;
    EXPECT_GE(f.z(), 0);
    EXPECT_LE(f.head<2>().norm(), p.friction * f.z() * (1 + 1e-12));
    if (t.phase == ContactPhase::kNone) {
      EXPECT_GE(p_F.z(), 0);
      EXPECT_EQ(t.force_W, Vector3::Zero());
      EXPECT_EQ(t.limit, Eigen::Vector2d::Zero());
      continue;
    }
    ++touched;
    sliding += t.phase == ContactPhase::kSliding;
    EXPECT_LE(p.tangential_stiffness * t.limit.norm(), p.friction * f.z() * (1 + 1e-12));
  }
  EXPECT_GT(touched, 300);
  EXPECT_GT(sliding, 100);
}

TEST(FaceContact, EndsAtTheEdges) {
  const Face face = doorFace(plainDoor(), {});
  const auto touches = [&](double y, double z, double depth) {
    return touch({}, face, {0.2 + depth, y, z}, Vector3::Zero(), {0, 0}).phase !=
           ContactPhase::kNone;
  };
  EXPECT_TRUE(touches(0.699, 1, 1e-3));
  EXPECT_FALSE(touches(0.701, 1, 1e-3));  // beyond the hinge
  EXPECT_TRUE(touches(-0.199, 1, 1e-3));
  EXPECT_FALSE(touches(-0.201, 1, 1e-3));  // beyond the edge of the leaf
  EXPECT_FALSE(touches(0, 2.01, 1e-3));
  EXPECT_FALSE(touches(0, 1, -1e-6));               // in front
  EXPECT_FALSE(touches(0, 1, 2 * kFaceThickness));  // behind: it went around
}

// The mass bounces, slides and sticks on a swinging door; the energy of both and of all springs may
// only fall.
TEST(FaceContact, CreatesNoEnergyOnASwingingDoor) {
  DoorParameters door = plainDoor();
  door.inertia = 1.5;
  door.closer_stiffness = 20;
  const RandomStream stream(11, "bounce");
  int phases[3] = {0, 0, 0};
  for (int run = 0; run < 20; ++run) {
    const auto u = stream.uniforms(run, 0);
    PointMass mass(withDoor(door), 0.4);
    mass.put({0.18, 0.1, 1}, {0.2 + u[0], u[1] - 0.5, u[2] - 0.5});
    mass.force << 6, 2 * u[3], 0;
    mass.state()[1] = -0.4 * u[1];
    double last = mass.energy();
    for (int n = 0; n < 1500; ++n) {
      mass.step();
      const double now = mass.energy();
      // Explicit steps across the onset of contact may err by a small share of a joule.
      ASSERT_LE(now, last + 2e-6 * (1 + std::abs(last))) << "run " << run << ", step " << n;
      last = std::min(last, now);
      ++phases[static_cast<int>(mass.observe().phase)];
    }
  }
  for (const int count : phases) EXPECT_GT(count, 100);
}

TEST(FaceContact, ActionOnTheDoorIsReactionOnThePoint) {
  PointMass mass(withDoor(plainDoor()), 1);
  mass.put({0.202, 0.1, 1}, {0.1, 0.3, 0});
  double sdot[4];
  const Vector3 force = mass.surroundings.derivative(mass.state(), mass.point(), sdot);
  EXPECT_GT(force.norm(), 1);
  const Vector3 arm = mass.point().p_W - Vector3(0.2, 0.7, 0);
  EXPECT_NEAR(plainDoor().inertia * sdot[1], arm.cross(-force).z(), 1e-12);
}

TEST(Surroundings, SayWhatIsWrongWithTheirConfiguration) {
  const auto complaint = [](const std::string& text) -> std::string {
    const ConfigNode tree = parseYaml("environment: {door: " + text + "}", "test.yaml");
    try {
      ConfigReader in(*tree.find("environment"), "environment");
      SurroundingsParameters read;
      readDescribed(in, read);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_NE(complaint("{hinge_m: [0, 1], closed_heading_deg: 0, opens: left, inertia_kgm2: 6}")
                .find("is 'left', must be one of: counterclockwise, clockwise"),
            std::string::npos);
  EXPECT_NE(complaint("{hinge_m: [0, 1], closed_heading_deg: 0, opens: clockwise, inertia_kgm2: 0}")
                .find("inertia_kgm2 is 0, must be between 0.001 and 10000"),
            std::string::npos);
  EXPECT_NE(complaint("{hinge_m: [0, 1], closed_heading_deg: 0, opens: clockwise, inertia_kgm2: 6, "
                      "dampin_Nms_per_rad: 2}")
                .find("did you mean"),
            std::string::npos);
}

}  // namespace
}  // namespace ballbot
