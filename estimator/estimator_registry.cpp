#include "estimator/estimator_registry.hpp"

#include "core/config_listing.hpp"
#include "estimator/complementary_observer.hpp"
#include "estimator/two_state_filter.hpp"

namespace ballbot {
namespace {

class ComplementaryEstimator final : public EstimatorSettings {
 public:
  explicit ComplementaryEstimator(const ComplementarySettings& settings) : settings_(settings) {}
  std::unique_ptr<Estimator> make(const RobotParameters& robot) const override {
    return std::make_unique<ComplementaryObserver>(robot, settings_);
  }
  double armRateTimeConstant() const override { return settings_.arm_rate_time_constant_s; }

 private:
  ComplementarySettings settings_;
};

class TwoStateEstimator final : public EstimatorSettings {
 public:
  explicit TwoStateEstimator(const TwoStateSettings& settings) : settings_(settings) {}
  std::unique_ptr<Estimator> make(const RobotParameters& robot) const override {
    if (settings_.spin.enabled) return std::make_unique<SpinTwoStateFilter>(robot, settings_);
    return std::make_unique<TwoStateFilter>(robot, settings_);
  }
  bool usesExternalPose() const override { return settings_.use_external_pose; }
  double armRateTimeConstant() const override { return settings_.arm_rate_time_constant_s; }

 private:
  TwoStateSettings settings_;
};

/// A kind whose settings struct describes itself.
template <typename Settings, typename Made>
EstimatorKind kindOf(const char* name) {
  return {name, [](ConfigVisitor& v) { Settings().describeOwn(v); },
          [](ConfigReader& in) -> std::unique_ptr<EstimatorSettings> {
            return std::make_unique<Made>(Settings::read(in));
          }};
}

const EstimatorKind& describeKind(ConfigVisitor& v) {
  return estimatorKinds().choose(
      v, must("kind", "which estimator; settings of the others are passed over"), "two_state");
}

void passOverOthers(ConfigReader& in) {
  for (const EstimatorKind& kind : estimatorKinds().all()) {
    ConfigListing listing;
    kind.describe(listing);
    for (const KeyEntry& entry : listing.take()) {
      if (entry.path.find('.') == std::string::npos) in.raw(entry.path);
    }
  }
}

}  // namespace

Registry<EstimatorKind>& estimatorKinds() {
  static Registry<EstimatorKind> kinds(
      {kindOf<ComplementarySettings, ComplementaryEstimator>("complementary"),
       kindOf<TwoStateSettings, TwoStateEstimator>("two_state")});
  return kinds;
}

std::shared_ptr<const EstimatorSettings> readEstimator(ConfigReader& in) {
  ConfigReading reading(in);
  const EstimatorKind& kind = describeKind(reading);
  std::shared_ptr<const EstimatorSettings> read = kind.read(in);
  passOverOthers(in);
  in.finish();
  return read;
}

void describeEstimator(ConfigVisitor& v) {
  describeKind(v);
  SharedSettings().describe(v);
  for (const EstimatorKind& kind : estimatorKinds().all()) kind.describe(v);
}

}  // namespace ballbot
