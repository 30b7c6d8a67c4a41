#include "estimator/estimator_factory.hpp"

#include "core/config_reader.hpp"
#include "estimator/complementary_observer.hpp"

namespace ballbot {
namespace {

enum class EstimatorKind { kComplementary };

}  // namespace

std::unique_ptr<Estimator> makeEstimator(ConfigReader& in, const RobotParameters& robot) {
  std::unique_ptr<Estimator> made;
  switch (in.choice<EstimatorKind>("kind", {{"complementary", EstimatorKind::kComplementary}})) {
    case EstimatorKind::kComplementary:
      made = std::make_unique<ComplementaryObserver>(robot, ComplementarySettings::read(in));
      break;
  }
  in.finish();
  return made;
}

}  // namespace ballbot
