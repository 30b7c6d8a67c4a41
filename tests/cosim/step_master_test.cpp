#include "cosim/step_master.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "cosim/lifecycle.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/spring_run.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::SpringParticipant;
using testing_support::SpringRun;
using testing_support::wordsOf;

/// A spring in this process, ready to be stepped.
struct LocalSpring {
  explicit LocalSpring(std::uint64_t seed = 1) : spring(seed) {}
  SpringParticipant spring;
  Lifecycle guarded{spring};
};

TEST(StepMaster, VisitsEveryEventOnceInOrderAndEndsAtTheEnd) {
  LocalSpring local;
  SpringRun run(local.guarded);
  std::vector<SimTime> times;
  run.master.setObserver([&](const Tick& tick) {
    EXPECT_EQ(tick.number, static_cast<std::int64_t>(times.size()));
    EXPECT_EQ(tick.sensors.time, tick.time);
    EXPECT_EQ(tick.truth->time, tick.time);
    times.push_back(tick.time);
    return true;
  });
  EXPECT_EQ(run.master.run(), StepMaster::End::kDuration);

  SimTime expected = kSimStart;
  for (const SimTime t : times) {
    EXPECT_EQ(t, expected);
    expected = run.calendar.nextAfter(t);
  }
  EXPECT_EQ(times.back(), kSimStart + SimDuration{100'000'000});
  // 0.1 s: 250 trackers and 40 estimators less 10 together, and the last event at the end.
  EXPECT_EQ(times.size(), 281U);
  EXPECT_EQ(local.guarded.state(), LifecycleState::kTerminated);
}

TEST(StepMaster, TheLastStepEndsAtTheDurationEvenBetweenEvents) {
  LocalSpring local;
  SpringRun run(local.guarded, SimDuration{1'000'100});
  run.master.run();
  EXPECT_EQ(local.guarded.time(), kSimStart + SimDuration{1'000'100});
}

TEST(StepMaster, TheObserverEndsTheRun) {
  LocalSpring local;
  SpringRun run(local.guarded);
  run.master.setObserver([](const Tick& tick) { return tick.number < 7; });
  EXPECT_EQ(run.master.run(), StepMaster::End::kObserver);
  EXPECT_EQ(run.master.tick(), 7);
  EXPECT_EQ(local.spring.stepsDone(), 7);
}

TEST(StepMaster, TheCommandOfAnEventActsFromThatEvent) {
  LocalSpring local;
  SpringRun run(local.guarded);
  JointVector velocity = JointVector::Zero(), torque, position;
  double h = 0;
  run.master.setObserver([&](const Tick& tick) {
    if (tick.number == 0) {
      torque = tick.control.command.torque;
      position = tick.truth->joint_angle;
      return true;
    }
    h = toSeconds(tick.time);
    velocity = tick.truth->joint_velocity;
    return false;
  });
  run.master.run();
  const JointVector expected = h * (-40.0 * position + torque);  // the spring's law, from rest
  EXPECT_LT((velocity - expected).norm(), 1e-15);
}

TEST(StepMaster, ACommandThatIsNotFiniteIsTheControllersFault) {
  LocalSpring local;
  SpringRun run(local.guarded);
  run.controller.commandNanFrom(kSimStart + SimDuration{2'000'000});
  EXPECT_EQ(wordsOf<LostParticipantError>([&] { run.master.run(); }),
            "tracker: command at 0.002000 s: torque_wheel3 is nan");
}

TEST(StepMaster, CtrlCStopsBeforeTheNextEvent) {
  LocalSpring local;
  EventCalendar calendar;
  const TaskId task = calendar.addTask("tracker", SimDuration{400'000});
  testing_support::SpringController controller(task, task);
  std::atomic<bool> stop{false};
  StepMaster master(local.guarded, controller, calendar, nullptr,
                    {kSimStart, kSimStart + SimDuration{10'000'000'000}, &stop});
  master.setObserver([&](const Tick& tick) {
    if (tick.number == 3) stop = true;
    return true;
  });
  EXPECT_EQ(wordsOf<InterruptedError>([&] { master.run(); }),
            "stopped at 0.001600 s of 10.000000 s");
}

TEST(StepMaster, ARunMustEndAfterItBegins) {
  LocalSpring local;
  EXPECT_THAT(wordsOf<InputError>([&] { SpringRun run(local.guarded, SimDuration{0}); }),
              HasSubstr("before it begins"));
}

TEST(StepMaster, TwiceTheSameRunIsTheSameDigestAndAnotherSeedIsNot) {
  LocalSpring a, b, c(2);
  const std::string digest = SpringRun(a.guarded).finish();
  EXPECT_EQ(digest.size(), 32U);
  EXPECT_EQ(SpringRun(b.guarded).finish(), digest);
  EXPECT_NE(SpringRun(c.guarded).finish(), digest);
}

TEST(StepMaster, ACheckpointContinuesBitForBitOnAFreshParticipant) {
  LocalSpring whole;
  const std::string expected = SpringRun(whole.guarded).finish();

  LocalSpring first, second;
  SpringRun run(first.guarded);
  run.master.initialize();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(run.master.step());
  const StateBlob bytes = run.master.save().toBlob();
  // What happens after the save, in participant and controller, must be undone by the restore.
  first.guarded.doStep(first.guarded.time(), SimDuration{100'000}, {});
  ControlOutput out;
  run.controller.onSensors(kSimStart, first.spring.sensors(), run.calendar.dueAt(kSimStart), out);

  run.master.replaceParticipant(second.guarded);
  run.master.restore(Checkpoint::fromBlob(bytes));
  EXPECT_EQ(run.master.tick(), 100);
  EXPECT_EQ(run.finish(), expected);
}

TEST(StepMaster, ACheckpointStartsANewRunThatGoesOnAlike) {
  LocalSpring original, copy;
  SpringRun run(original.guarded);
  run.master.initialize();
  for (int i = 0; i < 50; ++i) run.master.step();
  const Checkpoint checkpoint = run.master.save();

  SpringRun continued(copy.guarded);
  continued.master.restore(checkpoint);
  EXPECT_EQ(continued.master.time(), run.master.time());
  continued.master.run();
  run.master.run();
  EXPECT_EQ(copy.spring.stateDigest(), original.spring.stateDigest());
}

TEST(StepMaster, ADamagedCheckpointIsRefused) {
  LocalSpring local;
  SpringRun run(local.guarded);
  run.master.initialize();
  StateBlob bytes = run.master.save().toBlob();
  bytes[60] ^= 1;
  EXPECT_THAT(wordsOf<InputError>([&] { Checkpoint::fromBlob(bytes); }),
              HasSubstr("saved checkpoint state: damaged"));
}

}  // namespace
}  // namespace ballbot
