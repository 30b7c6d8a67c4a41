#include "controller/dead_drives.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kBandwidth = 40;   // [Hz]
constexpr double kSpeedLimit = 12;  // [rad/s]
constexpr double kTick = 0.4;       // [ms]

SimTime at(double ms) { return simTimeFromNs(static_cast<std::int64_t>(ms * 1e6)); }

class DeadDrivesTest : public testing::Test {
 protected:
  /// For so long, or until one is found dead; `arrives` of what a first-order loop would give.
  /// @return the time that passed [ms]
  double run(double duration_ms, const Vector3& asked, const Vector3& arrives,
             const WheelFlags& slipping = {}) {
    const double begin = ms_;
    for (; ms_ < begin + duration_ms && !any(drives_.dead()); ms_ += kTick) {
      drives_.update(at(ms_), asked, {arrives.cwiseProduct(loop_), velocity_}, slipping);
      loop_ += (1 - std::exp(-kTwoPi * kBandwidth * 1e-3 * kTick)) * (asked - loop_);
    }
    return ms_ - begin;
  }

  DeadDrives drives_{DriveLoss{}, {kBandwidth, kSpeedLimit}};
  Vector3 velocity_ = Vector3::Zero();
  double ms_ = 0;
  Vector3 loop_ = Vector3::Zero();
};

TEST_F(DeadDrivesTest, WhatIsAskedForAndDoesNotArriveIsFoundSoon) {
  run(200, {0.1, -1, 2}, {1, 1, 1});
  EXPECT_LE(run(200, {0.1, -1, 2}, {1, 0.05, 1}), 90);
  EXPECT_EQ(drives_.dead(), (WheelFlags{false, true, false}));
  EXPECT_EQ(drives_.deaths(), 1);
}

TEST_F(DeadDrivesTest, OfHalfATorqueOrTooLittleNothingIsSaid) {
  run(1000, {2, -2, 2}, {0.5, 0.3, 1.5});
  EXPECT_FALSE(any(drives_.dead()));
  run(1000, {0.4, 2, 2}, {0, 1, 1});
  EXPECT_FALSE(any(drives_.dead())) << "too little to tell";
}

TEST_F(DeadDrivesTest, DrivesThatAreWeakTogetherAreNotDead) {
  run(1000, {2, -2, 2}, {0.1, 0.1, 0.1});
  EXPECT_FALSE(any(drives_.dead()));
  run(1000, {2, -2, 2}, {0.05, 0.4, 0.4});
  EXPECT_FALSE(any(drives_.dead())) << "slow, and dragged";
}

TEST_F(DeadDrivesTest, AsLateAsItsLoopADriveIsNotDead) {
  for (int k = 0; k < 100; ++k) {
    const double sign = k % 2 == 0 ? 1 : -1;
    run(25, {3 * sign, 3 * sign, 3 * sign}, {1, 1, 1});
  }
  EXPECT_FALSE(any(drives_.dead()));
}

TEST_F(DeadDrivesTest, AWheelThatSlipsIsNone) {
  run(1000, {2, 2, 2}, {0, 1, 1}, {true, false, false});
  EXPECT_FALSE(any(drives_.dead()));
  EXPECT_LE(run(200, {2, 2, 2}, {0, 1, 1}), 90);
  EXPECT_EQ(drives_.dead(), (WheelFlags{true, false, false}));
}

TEST_F(DeadDrivesTest, AtTheEndOfItsSpeedADriveIsNotDead) {
  velocity_ << 0, -11, -11;
  run(1000, {2, -2, 2}, {1, 0, 1});
  EXPECT_FALSE(any(drives_.dead()));
  run(1000, {2, 2, 2}, {1, 0, 1});
  EXPECT_EQ(drives_.dead(), (WheelFlags{false, true, false})) << "asked to brake, it could";
}

TEST_F(DeadDrivesTest, IsTriedAgainLaterEachTimeAndLivesIfItDoes) {
  const auto deadFor = [&](const Vector3& arrives) {
    run(1000, {2, 2, 2}, arrives);
    EXPECT_TRUE(any(drives_.dead()));
    const double since = ms_;
    for (; any(drives_.dead()); ms_ += kTick) {
      loop_ = {2, 0, 2};
      drives_.update(at(ms_), {2, 0, 2}, {loop_, velocity_}, {});
    }
    return ms_ - since;
  };
  for (const double expected : {2000, 4000, 8000, 8000}) {
    EXPECT_NEAR(deadFor({1, 0, 1}), expected, 2);
  }
  run(5000, {2, 2, 2}, {1, 1, 1});
  EXPECT_FALSE(any(drives_.dead()));
  EXPECT_NEAR(deadFor({1, 0, 1}), 2000, 2) << "long ago";
}

}  // namespace
}  // namespace ballbot
