#pragma once

#include <memory>

#include "plant/multibody.hpp"

namespace ballbot {

/// The two structures behind makeMultibody(). The wheels' transverse inertia and mass belong to
/// the base in both; only their spin is theirs.
std::unique_ptr<Multibody> makeFullMultibody(const RobotParameters& robot,
                                             const MultibodyOptions& options);
std::unique_ptr<Multibody> makeReducedMultibody(const RobotParameters& robot,
                                                const MultibodyOptions& options);

}  // namespace ballbot
