#include "experiment/recording.hpp"

#include "core/config_visitor.hpp"

namespace ballbot {

void Recording::describe(ConfigVisitor& v) {
  log.describe(v);
  v.duration(may("checkpoint_period_s", "from one checkpoint to the next; 0 for none"),
             checkpoint_period, {0, 1e5});
}

}  // namespace ballbot
