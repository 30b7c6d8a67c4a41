// What the model does not know of and what lasts leaves the ball near its place after ten seconds,
// where it is learned; and does not, where it is not. Friction lets the robot sway by up to a
// centimetre about a place that is right (docs/theory/estimator.md has the figures of five seeds).
#include <gmock/gmock.h>

#include "tests/tools/scenario_run.hpp"

namespace ballbot {
namespace {

double finalBallError(const std::string& unknown, bool learned) {
  const auto json =
      summaryOf({"balance",
                 {"duration_s=12", unknown,
                  std::string("controller.offset_free.enabled=") + (learned ? "true" : "false")}});
  if (json.is_null() || json["fell"].get<bool>()) return 1;
  return json["final_ball_position_error_m"].get<double>();
}

TEST(OffsetFree, AMassThatNobodyTellsOfLeavesTheBallInItsPlace) {
  EXPECT_LT(finalBallError("environment.payload_kg=0.5", true), 0.015);
  EXPECT_LT(finalBallError("environment.payload_kg=2", true), 0.02);
  EXPECT_GT(finalBallError("environment.payload_kg=2", false), 0.1);
}

TEST(OffsetFree, ACentreOfMassThatIsOffLeavesTheBallInItsPlace) {
  EXPECT_LT(finalBallError("plant.base_com_offset_m=[0.003, 0, 0]", true), 0.01);
}

TEST(OffsetFree, ASlopeLeavesTheBallInItsPlace) {
  EXPECT_LT(finalBallError("environment.slope_deg=2", true), 0.012);
  EXPECT_GT(finalBallError("environment.slope_deg=2", false), 0.03);
}

}  // namespace
}  // namespace ballbot
