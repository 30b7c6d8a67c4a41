#include "controller/contact_supervisor.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/state_visitors.hpp"
#include "model/frames.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

/// Runs a supervisor at the planner's period with constant forces.
class Supervised {
 public:
  explicit Supervised(const ContactSupervision& options = {}) : supervisor(options) {}
  void run(double seconds, double asked, double measured) {
    const SimTime end = now_ + durationFromSeconds(seconds);
    for (; now_ < end; now_ += std::chrono::milliseconds(14)) {
      supervisor.update(now_, asked, measured);
    }
  }
  ContactSupervisor supervisor;

 private:
  SimTime now_ = kSimStart;
};

TEST(ContactSupervisor, PushesGentlyUntilItTouchesSomething) {
  Supervised s;
  s.run(1, 0, 0);
  EXPECT_EQ(s.supervisor.state(), ContactState::kNone);
  s.run(1, 5, 0.4);
  EXPECT_EQ(s.supervisor.state(), ContactState::kApproach);
  EXPECT_EQ(s.supervisor.situation().force_limit, 2);
  s.run(0.08, 5, 2);  // shorter than what counts as found
  s.run(0.1, 5, 0.4);
  EXPECT_EQ(s.supervisor.state(), ContactState::kApproach);
  s.run(0.15, 5, 2);
  EXPECT_EQ(s.supervisor.state(), ContactState::kContact);
  EXPECT_EQ(s.supervisor.situation().force_limit, std::numeric_limits<double>::infinity());
}

TEST(ContactSupervisor, DropsAForceThatIsNotThereAndStaysSo) {
  Supervised s;
  s.run(0.5, 5, 5);
  s.run(0.25, 5, 1.4);  // below 0.3 of 5 N, not yet for 0.3 s
  s.run(0.1, 5, 1.6);
  EXPECT_EQ(s.supervisor.state(), ContactState::kContact);
  s.run(0.35, 5, 1.4);
  EXPECT_EQ(s.supervisor.state(), ContactState::kLost);
  EXPECT_TRUE(s.supervisor.situation().lost);
  s.run(1, 5, 5);
  EXPECT_EQ(s.supervisor.state(), ContactState::kLost);
  s.run(0.1, 0, 0);
  s.run(0.5, 5, 5);
  EXPECT_EQ(s.supervisor.state(), ContactState::kContact);
}

TEST(ContactSupervisor, GivesUpWhenThereIsNothingToTouch) {
  Supervised s;
  s.run(3.9, 5, 0);
  EXPECT_EQ(s.supervisor.state(), ContactState::kApproach);
  s.run(0.2, 5, 0);
  EXPECT_EQ(s.supervisor.state(), ContactState::kLost);
}

TEST(ContactSupervisor, IntegratesTheForceErrorWithinItsLimit) {
  ContactSupervision options;
  options.integral_gain = 0.5;
  options.integral_limit_N = 1;
  Supervised s(options);
  s.run(0.2, 5, 4);
  ASSERT_EQ(s.supervisor.state(), ContactState::kContact);
  const double before = s.supervisor.situation().force_added;
  s.run(1.4, 5, 4);
  EXPECT_NEAR(s.supervisor.situation().force_added - before, 0.5 * 1.4 * 1, 1e-9);
  s.run(3, 5, 4);
  EXPECT_EQ(s.supervisor.situation().force_added, 1);
}

TEST(ContactSupervisor, ContinuesFromASavedState) {
  ContactSupervision options;
  options.integral_gain = 0.5;
  Supervised a(options);
  a.run(0.5, 5, 4);
  a.run(0.2, 5, 1);
  Supervised b = a;
  b.supervisor = ContactSupervisor(options);
  restoreStateOf(b.supervisor, saveStateOf(a.supervisor, "test", 1), "test", 1);
  for (Supervised* s : {&a, &b}) s->run(0.1, 5, 1);
  EXPECT_EQ(a.supervisor.state(), b.supervisor.state());
  EXPECT_EQ(a.supervisor.situation().force_added, b.supervisor.situation().force_added);
  for (Supervised* s : {&a, &b}) s->run(0.1, 5, 1);
  EXPECT_EQ(a.supervisor.state(), ContactState::kLost);
  EXPECT_EQ(b.supervisor.state(), ContactState::kLost);
}

TEST(ContactSupervision, SaysWhatIsWrong) {
  const ConfigNode tree = parseYaml("{lost_share: 1.5}", "test.yaml");
  ConfigReader in(tree);
  try {
    ContactSupervision::read(in);
    FAIL() << "was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("lost_share is 1.5, must be between 0 and 1"),
              std::string::npos)
        << e.what();
  }
}

// The end-effector on a door tells the door's angle, whichever way it opens.
TEST(TaskSchedule, TurnsTheContactFrameWithTheDoor) {
  TaskSchedule schedule(exampleRobot());
  schedule.contact_normal_W = -Vector3::UnitX();
  for (const double side : {0.7, -0.7}) {
    schedule.contact_hinge = Eigen::Vector2d(0.2, side);
    for (const double angle : {-0.3, 0.0, 0.2, 1.0}) {
      const Vector3 closed(0, -side, 0);
      const Vector3 p_WE = Vector3(0.2, side, 0.9) + expSO3({0, 0, angle}) * closed;
      EXPECT_NEAR(schedule.turnAboutHinge(p_WE), angle, 1e-12);
    }
  }
}

}  // namespace
}  // namespace ballbot
