#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/run_experiment.hpp"

namespace ballbot {

/// One experiment of Minniti et al. 2019 as it is repeated here.
struct PaperExperiment {
  std::string scenario;  ///< file of that name in configs/scenarios
  std::string title;
  std::string paper;                 ///< what the paper shows, in our words
  std::string here;                  ///< what was changed for the simulation, and why
  std::vector<std::string> metrics;  ///< the numbers that matter
  std::vector<std::string> panels;  ///< of its picture: ball, ee, ee_angles, tilt, arm, force, door
};

/// All of them, in the paper's order.
const std::vector<PaperExperiment>& paperExperiments();

/// A claim that takes two runs to judge.
struct Comparison {
  std::string claim;
  std::string measured;
  bool passed = false;
};

/// The claims whose runs are all among `results` (by scenario).
std::vector<Comparison> compareExperiments(const std::map<std::string, RunResult>& results);

}  // namespace ballbot
