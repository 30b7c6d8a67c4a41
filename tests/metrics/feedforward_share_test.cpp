#include "metrics/feedforward_share.hpp"

#include <gtest/gtest.h>

#include "core/state_visitors.hpp"

namespace ballbot {
namespace {

JointVector joints(double wheels, double arm1, double arm2, double arm3) {
  JointVector out;
  out << Vector3::Constant(wheels), arm1, arm2, arm3;
  return out;
}

TEST(FeedforwardShare, IsTheMeanOfTheSharesWhateverTheSigns) {
  FeedforwardShare share;
  share.add(joints(3, -9, 1, 0), joints(-1, 1, 1, 2));
  share.add(joints(1, 9, 1, 0), joints(1, -1, 0, 2));
  EXPECT_DOUBLE_EQ(share.values().at("feedforward_share_wheels_percent"), (75 + 50) / 2.0);
  EXPECT_DOUBLE_EQ(share.values().at("feedforward_share_arm1_percent"), 90);
  EXPECT_DOUBLE_EQ(share.values().at("feedforward_share_arm2_percent"), (50 + 100) / 2.0);
  EXPECT_DOUBLE_EQ(share.values().at("feedforward_share_arm3_percent"), 0);
}

TEST(FeedforwardShare, LeavesOutTorquesTooSmallToMean) {
  FeedforwardShare share;
  share.add(joints(0.02, 1, 0.01, 0), joints(0.02, 0, 0.01, 0));
  EXPECT_EQ(share.values().count("feedforward_share_wheels_percent"), 0u);
  EXPECT_EQ(share.values().count("feedforward_share_arm2_percent"), 0u);
  EXPECT_EQ(share.values().size(), 1u);
}

TEST(FeedforwardShare, GoesOnAfterARestore) {
  FeedforwardShare share, other;
  share.add(joints(1, 1, 1, 1), joints(3, 3, 3, 3));
  restoreStateOf(other, saveStateOf(share, "test", 1), "test", 1);
  share.add(joints(1, 1, 1, 1), joints(0, 0, 0, 0));
  other.add(joints(1, 1, 1, 1), joints(0, 0, 0, 0));
  EXPECT_EQ(share.values(), other.values());
}

}  // namespace
}  // namespace ballbot
