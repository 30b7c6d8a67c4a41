#include "cosim/schedule.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::wordsOf;

constexpr SimDuration us(std::int64_t n) { return SimDuration{1000 * n}; }

TEST(EventCalendar, TheRatesOfThePaperMeetExactly) {
  EventCalendar calendar;
  const TaskId tracker = calendar.addTask("tracker", us(400));
  const TaskId estimator = calendar.addTask("estimator", us(2500));
  const TaskId mpc = calendar.addTask("mpc", us(14'000));

  std::int64_t events = 0;
  std::array<std::int64_t, 3> runs{};
  for (SimTime t = kSimStart; t < kSimStart + us(7'000'000); t = calendar.nextAfter(t)) {
    const DueTasks due = calendar.dueAt(t);
    ASSERT_FALSE(due.none()) << toText(t);
    ++events;
    for (const TaskId task : {tracker, estimator, mpc}) {
      // Law: a task is due where its period divides the time, nowhere else.
      ASSERT_EQ(due.has(task), toNs(t) % toNs(calendar.period(task)) == 0) << toText(t);
      runs[task] += due.has(task) ? 1 : 0;
    }
  }
  EXPECT_EQ(runs[tracker], 7 * 2500);
  EXPECT_EQ(runs[estimator], 7 * 400);
  EXPECT_EQ(runs[mpc], 500);
  // Inclusion and exclusion of the multiples of 0.4, 2.5 and 14 ms in 7 s (14 ms is a whole
  // number of tracker periods).
  EXPECT_EQ(events, 7 * (2500 + 400 - 100));
}

TEST(EventCalendar, AnOffsetTaskStartsLater) {
  EventCalendar calendar;
  const TaskId late = calendar.addTask("late", us(1000), us(300));
  EXPECT_TRUE(calendar.dueAt(kSimStart).none());
  EXPECT_EQ(calendar.nextAfter(kSimStart), kSimStart + us(300));
  EXPECT_TRUE(calendar.dueAt(kSimStart + us(300)).has(late));
  EXPECT_EQ(calendar.nextAfter(kSimStart + us(300)), kSimStart + us(1300));
  EXPECT_FALSE(calendar.dueAt(kSimStart + us(1000)).has(late));
}

TEST(EventCalendar, NothingIsEverDueWithoutTasks) {
  EXPECT_EQ(EventCalendar{}.nextAfter(kSimStart), SimTime::max());
}

TEST(EventCalendar, APeriodThatDoesNotFitIsRefusedWithTheNearest) {
  EventCalendar calendar(us(500));
  EXPECT_EQ(wordsOf<InputError>([&] { calendar.addTask("imu", us(3300)); }),
            "imu period 3.3 ms is not a whole multiple of the base step 500 us. Nearest: 3 ms, 3.5 "
            "ms");
  EXPECT_EQ(wordsOf<InputError>(
                [&] { calendar.addTask("imu", us(3300), {}, "push.yaml:9:3: imu.period_ms"); }),
            "push.yaml:9:3: imu.period_ms 3.3 ms is not a whole multiple of the base step 500 us. "
            "Nearest: 3 ms, 3.5 ms");
  EXPECT_THAT(wordsOf<InputError>([&] { calendar.addTask("imu", us(100)); }),
              HasSubstr("Nearest: 500 us"));
  EXPECT_THAT(wordsOf<InputError>([&] { calendar.addTask("imu", us(0)); }),
              HasSubstr("imu period 0 s is not a whole multiple"));
  EXPECT_THAT(wordsOf<InputError>([&] { calendar.addTask("imu", us(1000), us(250)); }),
              HasSubstr("imu offset 250 us is not a whole multiple"));
  EXPECT_THAT(wordsOf<InputError>([&] { calendar.addTask("imu", us(1000), us(-500)); }),
              HasSubstr("must not be negative"));
  EXPECT_EQ(calendar.taskCount(), 0U);
}

TEST(EventCalendar, SixtyHertzIsNoWholeNumberOfNanoseconds) {
  EventCalendar calendar;
  EXPECT_THAT(wordsOf<InputError>([&] { calendar.addTask("camera", SimDuration{16'666'667}); }),
              HasSubstr("Nearest: 16.6 ms, 16.7 ms"));
}

TEST(EventCalendar, NamesTheTasksThereAre) {
  EventCalendar calendar;
  calendar.addTask("tracker", us(400));
  const TaskId mpc = calendar.addTask("mpc", us(14'000));
  EXPECT_EQ(calendar.find("mpc"), mpc);
  EXPECT_THAT(wordsOf<InputError>([&] { calendar.find("mcp"); }),
              HasSubstr("no task 'mcp' in the calendar; there are: tracker, mpc"));
}

TEST(EventCalendar, HoldsNoMoreTasksThanItCanTellApart) {
  EventCalendar calendar;
  for (std::size_t i = 0; i < EventCalendar::kMaxTasks; ++i) calendar.addTask("t", us(100));
  EXPECT_THAT(wordsOf<InputError>([&] { calendar.addTask("last", us(100)); }),
              HasSubstr("last is one too many"));
  EXPECT_TRUE(calendar.dueAt(kSimStart).has(EventCalendar::kMaxTasks - 1));
}

TEST(EventCalendar, ABaseStepMustBePositive) {
  EXPECT_THAT(wordsOf<InputError>([] { EventCalendar calendar(SimDuration{0}); }),
              HasSubstr("base step is 0 s, must be above 0"));
}

}  // namespace
}  // namespace ballbot
