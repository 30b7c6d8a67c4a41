#include "controller/latest_value.hpp"

#include <array>
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(LatestValue, GivesTheNewestAndOnlyOnce) {
  LatestValue<int> value(0);
  EXPECT_FALSE(value.update());
  EXPECT_EQ(value.front(), 0);
  for (int i = 1; i <= 3; ++i) {
    value.back() = i;
    value.publish();
  }
  EXPECT_TRUE(value.update());
  EXPECT_EQ(value.front(), 3);
  EXPECT_FALSE(value.update());
  EXPECT_EQ(value.front(), 3);
}

TEST(LatestValue, AReaderNeverSeesAHalfWrittenOrAnOlderValue) {
  using Block = std::array<int, 64>;
  LatestValue<Block> value(Block{});
  constexpr int kLast = 20000;
  std::atomic<bool> torn{false}, backward{false};
  std::thread reader([&] {
    int newest = 0;
    while (newest < kLast) {
      if (!value.update()) {
        std::this_thread::yield();
        continue;
      }
      const Block& block = value.front();
      for (int v : block) {
        if (v != block[0]) torn = true;
      }
      if (block[0] <= newest) backward = true;
      newest = block[0];
    }
  });
  for (int i = 1; i <= kLast; ++i) {
    value.back().fill(i);
    value.publish();
    if (i % 16 == 0) std::this_thread::yield();
  }
  reader.join();
  EXPECT_FALSE(torn);
  EXPECT_FALSE(backward);
}

}  // namespace
}  // namespace ballbot
