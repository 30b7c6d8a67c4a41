// Margins twice: from the linear loop of `ballbot bode`, and from the whole robot, nonlinear, with
// noise and friction, with a gain or a delay put into its loop, far enough beyond the margin for
// it to fall; tests/experiment/sampled_loop_test.cpp looks at where small disturbances begin to
// grow.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/scenario_run.hpp"

namespace ballbot {
namespace {

class Margins : public ::testing::Test {
 protected:
  Margins() {
    const Finished bode = runBallbot({"bode", scenarioPath("balance"), "--json"}, 60);
    EXPECT_EQ(bode.exit_code, 0) << bode.err;
    linear_ = nlohmann::json::parse(bode.out)["margins"];
  }
  double linear(const char* margin) const { return linear_.at(margin).get<double>(); }

  /// Whether the robot, let go three degrees off balance, falls within eight seconds.
  static bool falls(const std::string& insertion) {
    return summaryOf({"balance",
                      {"duration_s=8", "requirements={}", "plant.fidelity.multibody=reduced_wheels",
                       "plant.wheel_loop_insertion={" + insertion + "}"}})["fell"]
        .get<bool>();
  }

 private:
  nlohmann::json linear_;
};

TEST_F(Margins, TheRobotTakesTheGainThatTheLinearLoopTakes) {
  const double high = linear("wheel_gain_margin_high"), low = linear("wheel_gain_margin_low");
  // Noise times such a gain reaches the wheels' torque limit before the loop is unstable.
  EXPECT_FALSE(falls(fmt::format("gain: {}", 0.5 * high)));
  EXPECT_TRUE(falls(fmt::format("gain: {}", 1.4 * high)));
  EXPECT_FALSE(falls(fmt::format("gain: {}", 1.3 * low)));
  EXPECT_TRUE(falls(fmt::format("gain: {}", 0.8 * low)));
}

TEST_F(Margins, TheRobotTakesTheDelayThatTheLinearLoopTakes) {
  const double ticks = linear("wheel_delay_margin_ms") / 0.4;  // the drives' period
  EXPECT_FALSE(falls(fmt::format("delay_ticks: {}", std::lround(0.8 * ticks))));
  // In between it swings, by 20 degrees at 1.4, and the plan's limits of tilt and wheel rates keep
  // it up.
  EXPECT_TRUE(falls(fmt::format("delay_ticks: {}", std::lround(1.7 * ticks))));
}

}  // namespace
}  // namespace ballbot
