#pragma once

#include <memory>

#include "controller/law_registry.hpp"

namespace ballbot::test {

/// The law that a `controller:` section names, without the rest of the section.
inline std::unique_ptr<ControlLaw> makeControlLaw(ConfigReader& in, const RobotParameters& robot) {
  ConfigReading reading(in);
  return lawKinds().choose(reading, must("kind", "which law"), "lqr").read(in, robot)->makeLaw();
}

}  // namespace ballbot::test
