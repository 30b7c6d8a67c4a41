#include "experiment/recording.hpp"

#include "core/config_visitor.hpp"

namespace ballbot {

void Recording::describe(ConfigVisitor& v) {
  log.describe(v);
  v.duration(may("checkpoint_period_s", "from one checkpoint to the next; 0 for none"),
             checkpoint_period, {0, 1e5});
}

Recording readRecording(const Scenario& scenario) {
  Recording out;
  out.log.sensors = out.log.estimate = scenario.rates.estimator;
  if (const ConfigNode* node = scenario.tree.find("recording")) {
    ConfigReader in(*node, "recording");
    readDescribed(in, out);
    in.finish();
  }
  return out;
}

}  // namespace ballbot
