#include "estimator/estimator_factory.hpp"

#include "core/config_reader.hpp"
#include "estimator/complementary_observer.hpp"
#include "estimator/two_state_filter.hpp"

namespace ballbot {
namespace {

enum class EstimatorKind { kComplementary, kTwoState };

// A file may hold the settings of both, so that `kind` alone can be changed; those of the other are
// passed over.
constexpr const char* kOnlyComplementary[] = {"velocity_bandwidth_rad_per_s",
                                              "tilt_bandwidth_rad_per_s",
                                              "gyro_bias_time_constant_s",
                                              "velocity_innovation_limit_m_per_s"};
constexpr const char* kOnlyTwoState[] = {"iterations", "imu_wait_ms", "noise", "initial",
                                         "gate", "balance", "external_pose", "initial_tilt_error_deg"};

}  // namespace

std::unique_ptr<Estimator> makeEstimator(ConfigReader& in, const RobotParameters& robot) {
  std::unique_ptr<Estimator> made;
  switch (in.choice<EstimatorKind>("kind", {{"complementary", EstimatorKind::kComplementary},
                                            {"two_state", EstimatorKind::kTwoState}})) {
    case EstimatorKind::kComplementary:
      for (const char* key : kOnlyTwoState) in.raw(key);
      made = std::make_unique<ComplementaryObserver>(robot, ComplementarySettings::read(in));
      break;
    case EstimatorKind::kTwoState:
      for (const char* key : kOnlyComplementary) in.raw(key);
      made = std::make_unique<TwoStateFilter>(robot, TwoStateSettings::read(in));
      break;
  }
  in.finish();
  return made;
}

}  // namespace ballbot
