#include "estimator/shared_settings.hpp"

#include "core/config_visitor.hpp"

namespace ballbot {

void SharedSettings::describe(ConfigVisitor& v) {
  v.number(may("arm_rate_time_constant_s", "of the low pass on the rates of the arm's joints"),
           arm_rate_time_constant_s, {0, 0.1});
  v.integer(may("alignment_samples", "IMU samples at rest before the estimate is aligned"),
            alignment_samples, {1, 1e6});
}

}  // namespace ballbot
