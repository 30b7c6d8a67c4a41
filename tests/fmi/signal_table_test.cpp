#include "model/signal_table.hpp"

#include <set>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

template <typename Frame>
void expectRoundTrip(const std::vector<Signal<Frame>>& signals) {
  Frame frame;
  double next = 0.1;
  std::set<std::string> names;
  for (const auto& s : signals) {
    EXPECT_TRUE(names.insert(s.name).second) << s.name << " stands twice";
    std::vector<double> in(static_cast<std::size_t>(s.size)), out(in.size());
    for (double& value : in)
      value = isWhole(s.kind) ? s.kind != SignalKind::kFlag ? 3 : 1
                              : 1e-9 * std::round(1e9 * (next *= 1.37));
    s.write(frame, in.data());
    s.read(frame, out.data());
    if (s.kind == SignalKind::kTime) {
      EXPECT_EQ(std::llround(1e9 * in[0]), std::llround(1e9 * out[0])) << s.name;
    } else {
      EXPECT_EQ(in, out) << s.name;
    }
  }
}

TEST(SignalTable, WhatIsWrittenIsRead) {
  expectRoundTrip(commandSignals());
  expectRoundTrip(externalForceSignals());
  expectRoundTrip(sensorSignals());
  expectRoundTrip(truthSignals());
  expectRoundTrip(estimateSignals());
  expectRoundTrip(planSignals());
}

TEST(SignalTable, NamesTheElementsOfAllThatHaveNames) {
  std::set<std::string> columns;
  for (const auto& s : truthSignals()) {
    for (int i = 0; i < s.size; ++i) {
      EXPECT_TRUE(columns.insert(columnName(s, i)).second) << s.name << " " << i;
    }
  }
  EXPECT_EQ(columns.count("joint_torque_wheel2"), 1U);
  EXPECT_EQ(columns.count("base_angles_pitch"), 1U);
  EXPECT_EQ(columns.count("quat_WE_w"), 1U);
  EXPECT_EQ(columns.count("door_angle"), 1U);
}

}  // namespace
}  // namespace ballbot
