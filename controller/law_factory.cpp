#include "controller/law_factory.hpp"

#include "controller/lqr_law.hpp"
#include "core/config_reader.hpp"

namespace ballbot {

std::unique_ptr<ControlLaw> makeControlLaw(ConfigReader& in, const RobotParameters& robot) {
  enum class Kind { kLqr };
  const Kind kind = in.choice<Kind>("kind", {{"lqr", Kind::kLqr}});
  switch (kind) {
    case Kind::kLqr:
      break;
  }
  ConfigReader lqr = in.child("lqr");
  return std::make_unique<LqrLaw>(robot, LqrLawConfig::read(lqr, robot));
}

}  // namespace ballbot
