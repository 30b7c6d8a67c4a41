#include "estimator/estimator_factory.hpp"

#include "core/config_reader.hpp"
#include "estimator/complementary_observer.hpp"
#include "estimator/two_state_filter.hpp"

namespace ballbot {
namespace {

enum class EstimatorKind { kComplementary, kTwoState };

}  // namespace

std::unique_ptr<Estimator> makeEstimator(ConfigReader& in, const RobotParameters& robot) {
  std::unique_ptr<Estimator> made;
  switch (in.choice<EstimatorKind>("kind", {{"complementary", EstimatorKind::kComplementary},
                                            {"two_state", EstimatorKind::kTwoState}})) {
    case EstimatorKind::kComplementary:
      made = std::make_unique<ComplementaryObserver>(robot, ComplementarySettings::read(in));
      break;
    case EstimatorKind::kTwoState:
      made = std::make_unique<TwoStateFilter>(robot, TwoStateSettings::read(in));
      break;
  }
  in.finish();
  return made;
}

}  // namespace ballbot
