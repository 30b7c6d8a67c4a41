#include <thread>

#include <gtest/gtest.h>

#include "hil/deadline_schedule.hpp"
#include "hil/jitter_histogram.hpp"
#include "hil/spsc_ring.hpp"

namespace ballbot {
namespace {

TEST(DeadlineSchedule, DeadlinesAreAbsolute) {
  DeadlineSchedule s(1000, 100);
  EXPECT_EQ(s.deadline(), 1000);
  EXPECT_EQ(s.advance(1090), 0) << "a cycle that took 90 of 100";
  EXPECT_EQ(s.deadline(), 1100) << "lateness does not add up";
}

TEST(DeadlineSchedule, SkipsWhatWasMissedAndNeverCatchesUpInABurst) {
  DeadlineSchedule s(0, 100);
  EXPECT_EQ(s.advance(150), 0);
  EXPECT_EQ(s.deadline(), 100) << "begins late, but its period is not over";
  EXPECT_EQ(s.overruns(), 1);
  EXPECT_EQ(s.advance(560), 3) << "200, 300 and 400 are over; 500 runs now";
  EXPECT_EQ(s.deadline(), 500);
  EXPECT_EQ(s.advance(590), 0);
  EXPECT_EQ(s.deadline(), 600);
  EXPECT_EQ(s.skipped(), 3);
}

TEST(JitterHistogram, PercentilesAreWithinABinOfTheSorted) {
  JitterHistogram h;
  EXPECT_EQ(h.percentile(0.5), 0);
  for (int i = 1; i <= 1000; ++i) h.add(i * 700);
  EXPECT_NEAR(static_cast<double>(h.percentile(0.5)), 350'000, 1000);
  EXPECT_NEAR(static_cast<double>(h.percentile(0.99)), 693'000, 1400);
  EXPECT_EQ(h.percentile(1), 700'000);
  h.add(50'000'000);
  EXPECT_EQ(h.max(), 50'000'000);
  EXPECT_EQ(h.percentile(1), 50'000'000);
  h.add(-5);
  EXPECT_EQ(h.count(), 1002) << "early counts as not late";
}

TEST(SpscRing, KeepsTheOrderBetweenTwoThreadsAndRefusesWhenFull) {
  SpscRing<int> small(3);
  int n = 0;
  while (small.push(n)) ++n;
  EXPECT_EQ(n, 4) << "rounded up to a power of two";
  int out = -1;
  EXPECT_TRUE(small.pop(out));
  EXPECT_EQ(out, 0);
  EXPECT_TRUE(small.push(4));

  SpscRing<int> ring(64);
  constexpr int kCount = 200'000;
  std::thread producer([&] {
    for (int i = 0; i < kCount;) {
      if (ring.push(i)) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  for (int i = 0; i < kCount;) {
    if (!ring.pop(out)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(out, i++);
  }
  producer.join();
}

}  // namespace
}  // namespace ballbot
