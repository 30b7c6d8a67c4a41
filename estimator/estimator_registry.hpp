#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/registry.hpp"
#include "estimator/estimator.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

/// What was read of an estimator: makes it, and says what others have to know of it.
class EstimatorSettings {
 public:
  virtual ~EstimatorSettings() = default;

  /// @param robot  as the controller believes it to be
  virtual std::unique_ptr<Estimator> make(const RobotParameters& robot) const = 0;
  /// It is told the pose from outside: its estimates are meant in W, not from where the robot was
  /// put down.
  virtual bool usesExternalPose() const { return false; }
  /// Of the low pass through which the arm's rates come, 0 for none; for analysis of loops [s].
  virtual double armRateTimeConstant() const { return 0; }
};

/// An estimator as a scenario chooses it: `estimator.kind: NAME`.
struct EstimatorKind {
  std::string name;
  /// Its own keys, beside `kind` and those of SharedSettings.
  std::function<void(ConfigVisitor&)> describe;
  /// From the `estimator:` section; reads its own keys of it and the shared ones, leaves the rest.
  /// @throw InputError
  std::function<std::unique_ptr<EstimatorSettings>(ConfigReader&)> read;
};

/// The two-state filter and the complementary observer, and what others added (docs/adding.md).
Registry<EstimatorKind>& estimatorKinds();

/// The whole `estimator:` section; a file may hold the keys of several kinds, so that `kind` alone
/// can be changed: those of the others are passed over. Finishes the reader.
/// @throw InputError with file:line:column
std::shared_ptr<const EstimatorSettings> readEstimator(ConfigReader& in);

/// All keys of `estimator:`, of every kind, with their defaults; for references and the like.
void describeEstimator(ConfigVisitor& v);

}  // namespace ballbot
