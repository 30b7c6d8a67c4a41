#pragma once

#include <memory>

#include "plant/multibody.hpp"

namespace ballbot {

/// The structures on a rigid floor behind makeMultibody(). The wheels' transverse inertia and mass
/// belong to the base in both; only their spin is theirs.
std::unique_ptr<Multibody> makeFullMultibody(const RobotParameters& robot,
                                             const MultibodyOptions& options);
std::unique_ptr<Multibody> makeReducedMultibody(const RobotParameters& robot,
                                                const MultibodyOptions& options);
/// The one behind options.floor; wheels are bodies. y[2] is the height of the ball's centre [m].
std::unique_ptr<Multibody> makeCompliantMultibody(const RobotParameters& robot,
                                                  const MultibodyOptions& options);

}  // namespace ballbot
