#pragma once

#include <memory>

#include "estimator/estimator.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// The estimator that `kind` in the mapping names, with its settings from the same mapping, e.g.
/// configs/estimators/complementary.yaml. Finishes the reader.
/// @throw InputError with file:line:column
std::unique_ptr<Estimator> makeEstimator(ConfigReader& in, const RobotParameters& robot);

/// All keys of `estimator:`, of either kind, with their defaults; for references and the like.
void describeEstimator(ConfigVisitor& v);

}  // namespace ballbot
