#include "experiment/loop_schedule.hpp"

#include <algorithm>
#include <chrono>
#include <set>

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr LoopPeriods kUsual{microseconds(400), microseconds(2500), microseconds(2500),
                             milliseconds(14),  microseconds(400),  milliseconds(12)};

template <typename Which>
auto count(const LoopSchedule& schedule, const Which& which) {
  return std::count_if(schedule.events.begin(), schedule.events.end(), which);
}

std::set<SimDuration> agesTracked(const LoopSchedule& schedule) {
  std::set<SimDuration> ages;
  for (const LoopEvent& e : schedule.events) {
    if (e.track) ages.insert(e.plan_age);
  }
  return ages;
}

TEST(LoopSchedule, ComesAgainWhenAllRatesDo) {
  const LoopSchedule schedule = makeLoopSchedule(kUsual);
  EXPECT_EQ(schedule.period, milliseconds(70));
  EXPECT_EQ(count(schedule, [](const LoopEvent& e) { return e.drives; }), 175);
  EXPECT_EQ(count(schedule, [](const LoopEvent& e) { return e.track; }), 175);
  EXPECT_EQ(count(schedule, [](const LoopEvent& e) { return e.estimate; }), 28);
  EXPECT_EQ(count(schedule, [](const LoopEvent& e) { return e.plan; }), 5);
  EXPECT_EQ(count(schedule, [](const LoopEvent& e) { return e.activate; }), 5);
  SimDuration sum{};
  for (const LoopEvent& e : schedule.events) sum += e.until_next;
  EXPECT_EQ(sum, schedule.period);
}

TEST(LoopSchedule, APlanActsFromItsLatencyOnUntilTheNextDoes) {
  const std::set<SimDuration> ages = agesTracked(makeLoopSchedule(kUsual));
  EXPECT_EQ(*ages.begin(), milliseconds(12));
  EXPECT_EQ(*ages.rbegin(), milliseconds(26) - microseconds(400));
}

TEST(LoopSchedule, WithoutLatencyAPlanActsAtOnce) {
  LoopPeriods prompt = kUsual;
  prompt.plan_latency = SimDuration::zero();
  const LoopSchedule schedule = makeLoopSchedule(prompt);
  EXPECT_EQ(*agesTracked(schedule).begin(), SimDuration::zero());
  for (const LoopEvent& e : schedule.events) EXPECT_EQ(e.plan, e.at_once);
}

TEST(LoopSchedule, APlanThatWaitsLongerThanAPeriodKeepsTheNextFromBeingMade) {
  LoopPeriods slow = kUsual;
  slow.plan_latency = milliseconds(20);
  const LoopSchedule schedule = makeLoopSchedule(slow);
  // One in two periods of the planner, of which five make a common period: it takes two of those.
  EXPECT_EQ(schedule.period, milliseconds(140));
  EXPECT_EQ(count(schedule, [](const LoopEvent& e) { return e.plan; }), 5);
  EXPECT_EQ(*agesTracked(schedule).rbegin(), milliseconds(48) - microseconds(400));
}

TEST(LoopSchedule, EstimatesAreAsOldAsTheSamplesTheyAreFrom) {
  LoopPeriods slow_imu = kUsual;
  slow_imu.imu = milliseconds(5);
  SimDuration imu{}, frame{};
  for (const LoopEvent& e : makeLoopSchedule(slow_imu).events) {
    imu = std::max(imu, e.imu_age);
    frame = std::max(frame, e.frame_age);
  }
  EXPECT_EQ(frame, microseconds(2400));
  EXPECT_EQ(imu, microseconds(4800));  // 5 ms less what is common to it and the tracker
}

TEST(LoopSchedule, RefusesRatesThatDoNotComeTogether) {
  LoopPeriods odd = kUsual;
  odd.planner = microseconds(14'300);
  odd.estimator = microseconds(1'700);
  odd.drives = microseconds(1'100);
  odd.imu = microseconds(1'900);
  try {
    makeLoopSchedule(odd);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("planner (14.3 ms)"));
  }
}

}  // namespace
}  // namespace ballbot
