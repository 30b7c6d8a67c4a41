#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

nlohmann::json bodeJson(std::vector<std::string> more) {
  std::vector<std::string> arguments = {"bode", scenarioPath("balance"), "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished run = runBallbot(arguments, 60);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out, nullptr, false);
}

TEST(Bode, GivesShapingActuatorAndCrossoverAsNumbers) {
  const auto json = bodeJson({});
  EXPECT_EQ(json["shaping"]["zero_rad_per_s"], 100);
  EXPECT_NEAR(json["actuators"]["wheel"]["blocked_bandwidth_Hz"].get<double>(), 44,
              2);  // docs/theory/actuator.md
  const auto& loop = json["continuous_loop_at_the_wheels"];
  EXPECT_GT(loop["series_elastic_drives"]["crossover_rad_per_s"].get<double>(),
            10.4);  // twice the unstable pole
  EXPECT_NEAR(loop["delay_ms"].get<double>(), 1.0,
              1e-9);  // two drive ticks and half a tracker period
}

TEST(Bode, HasTheMarginsOfTheLawInForce) {
  const auto mpc = bodeJson({})["margins"];
  EXPECT_TRUE(mpc["stable"].get<bool>());
  EXPECT_EQ(mpc["repeats_after_ms"], 70);
  // With so much more the robot stands at 16 ms, and cycles at 18.
  EXPECT_GT(mpc["delay_margin_ms"].get<double>(), 14);
  EXPECT_LT(mpc["delay_margin_ms"].get<double>(), 18);
  const auto tracker = bodeJson({"--set", "controller.tracker.policy_feedback=0"})["margins"];
  EXPECT_TRUE(tracker["stable"].get<bool>()) << "for the paper's tracker does balance";
  EXPECT_LT(tracker["wheel_gain_margin_high"].get<double>(),
            0.5 * mpc["wheel_gain_margin_high"].get<double>());
  EXPECT_NE(bodeJson({"--set", "controller.kind=lqr"})["margins"], mpc);
  EXPECT_EQ(bodeJson({"--delay-ms", "20"})["margins"], mpc) << "of the picture alone";
}

TEST(Bode, RefusesALawThatRemembersWhatItDoesNotKnowOf) {
  const Finished run =
      runBallbot({"bode", scenarioPath("balance"), "--set", "controller.kind=decoupled"}, 60);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("its loop cannot be analysed"));
}

TEST(Bode, ComputesTheShapingFromTheActuatorsBandwidth) {
  const auto json = bodeJson({"--set", "controller.mpc.wheel_shaping={actuator_bandwidth_Hz: 10}"});
  EXPECT_NEAR(json["shaping"]["zero_rad_per_s"].get<double>(), 0.75 * 2 * M_PI * 10, 1e-9);
  EXPECT_NEAR(json["shaping"]["weight_at_infinity"].get<double>(), 2 * 15 * 15, 1e-9);
}

TEST(Bode, WritesEveryCurveAsCsvAndAPicture) {
  const TemporaryFolder folder;
  const Finished run = runBallbot(
      {"bode", scenarioPath("balance"), "--csv", folder / "bode.csv", "--out", folder / "bode.svg"},
      60);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("crossover"));
  std::istringstream csv(readFile(folder / "bode.csv"));
  std::string header, row;
  std::getline(csv, header);
  EXPECT_THAT(header, StartsWith("frequency_Hz,shaping_gain"));
  int rows = 0;
  while (std::getline(csv, row)) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','),
              std::count(header.begin(), header.end(), ','));
    EXPECT_EQ(row.find("nan"), std::string::npos);
    ++rows;
  }
  EXPECT_GT(rows, 500);
  EXPECT_THAT(readFile(folder / "bode.svg"), StartsWith("<svg"));
}

TEST(Bode, SaysWhenTheCostDoesNotSeeTheBall) {
  const Finished run = runBallbot(
      {"bode", scenarioPath("balance"), "--set", "controller.mpc.tasks.ball_position.weight=0",
       "--set", "controller.mpc.tasks.ball_velocity.weight=0"},
      60);
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("Riccati equation has no usable solution"));
}

}  // namespace
}  // namespace ballbot
