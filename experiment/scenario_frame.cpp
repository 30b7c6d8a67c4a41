#include "experiment/scenario_frame.hpp"

#include "core/angle.hpp"
#include "core/config_reader.hpp"

namespace ballbot {

HomeFrame homeFrame(const Scenario& scenario) {
  HomeFrame home;  // the plant puts every robot down at W's origin
  const ConfigNode* initial = scenario.tree.find("initial");
  if (!initial || scenario.section("estimator").find("external_pose")) return home;
  home.yaw = kRadPerDeg * ConfigReader(*initial, "initial").numberOr("yaw_deg", 0, {-180, 180});
  return home;
}

void seeFromHome(const HomeFrame& home, RunLog& log) {
  for (TruthFrame& truth : log.truth) truth = home.see(truth);
}

}  // namespace ballbot
