#include "plant/multibody.hpp"

#include "plant/multibody_structures.hpp"
#include "plant/simbody_library.hpp"

namespace ballbot {

std::unique_ptr<Multibody> makeMultibody(const RobotParameters& robot,
                                         const MultibodyOptions& options) {
  requireSimbodyKind(loadedSimbodyKind());
  if (options.floor) return makeCompliantMultibody(robot, options);
  return options.structure == MultibodyStructure::kFull ? makeFullMultibody(robot, options)
                                                        : makeReducedMultibody(robot, options);
}

}  // namespace ballbot
