#include "estimator/estimator_factory.hpp"

#include "core/config_listing.hpp"
#include "estimator/complementary_observer.hpp"
#include "estimator/two_state_filter.hpp"

namespace ballbot {
namespace {

enum class EstimatorKind { kComplementary, kTwoState };

void describeKind(ConfigVisitor& v, EstimatorKind& kind) {
  v.choice(
      must("kind", "which estimator; settings of the other are passed over"), kind,
      {{"complementary", EstimatorKind::kComplementary}, {"two_state", EstimatorKind::kTwoState}});
}

/// A file may hold the settings of both, so that `kind` alone can be changed; those of the other
/// are passed over.
template <typename Settings>
void passOver(ConfigReader& in) {
  ConfigListing listing;
  Settings().describe(listing);
  for (const KeyEntry& entry : listing.take()) {
    if (entry.path.find('.') == std::string::npos) in.raw(entry.path);
  }
}

}  // namespace

std::unique_ptr<Estimator> makeEstimator(ConfigReader& in, const RobotParameters& robot) {
  ConfigReading reading(in);
  auto kind = EstimatorKind::kTwoState;
  describeKind(reading, kind);
  std::unique_ptr<Estimator> made;
  switch (kind) {
    case EstimatorKind::kComplementary:
      passOver<TwoStateSettings>(in);
      made = std::make_unique<ComplementaryObserver>(robot, ComplementarySettings::read(in));
      break;
    case EstimatorKind::kTwoState:
      passOver<ComplementarySettings>(in);
      made = std::make_unique<TwoStateFilter>(robot, TwoStateSettings::read(in));
      break;
  }
  in.finish();
  return made;
}

void describeEstimator(ConfigVisitor& v) {
  auto kind = EstimatorKind::kTwoState;
  describeKind(v, kind);
  TwoStateSettings().describe(v);
  ComplementarySettings().describeOwn(v);
}

}  // namespace ballbot
