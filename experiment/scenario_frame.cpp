#include "experiment/scenario_frame.hpp"

namespace ballbot {

void seeFromHome(const HomeFrame& home, RunLog& log) {
  for (TruthFrame& truth : log.truth) truth = home.see(truth);
}

}  // namespace ballbot
