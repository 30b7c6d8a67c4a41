#include "plant/multibody.hpp"

#include "plant/multibody_structures.hpp"

namespace ballbot {

std::unique_ptr<Multibody> makeMultibody(const RobotParameters& robot,
                                         const MultibodyOptions& options) {
  if (options.floor) return makeCompliantMultibody(robot, options);
  return options.structure == MultibodyStructure::kFull ? makeFullMultibody(robot, options)
                                                        : makeReducedMultibody(robot, options);
}

}  // namespace ballbot
