#include "controller/law_factory.hpp"

#include <fmt/format.h>

#include "controller/background_mpc_law.hpp"
#include "controller/decoupled_law.hpp"
#include "controller/lqr_law.hpp"
#include "controller/mpc_law.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

LqrLawConfig readLqr(ConfigReader& in, const RobotParameters& robot) {
  ConfigReader lqr = in.child("lqr");
  return LqrLawConfig::read(lqr, robot);
}

std::unique_ptr<ControlLaw> makeLaw(ConfigReader& in, const RobotParameters& robot) {
  enum class Kind { kLqr, kMpc, kDecoupled };
  const Kind kind = in.choice<Kind>(
      "kind", {{"lqr", Kind::kLqr}, {"mpc", Kind::kMpc}, {"decoupled", Kind::kDecoupled}});
  switch (kind) {
    case Kind::kLqr:
      return std::make_unique<LqrLaw>(robot, readLqr(in, robot));
    case Kind::kMpc:
    case Kind::kDecoupled: {
      ConfigReader mpc = in.child("mpc");
      MpcConfig config = MpcConfig::read(mpc, robot);
      if (in.has("lqr")) config.lqr = readLqr(in, robot);
      if (kind == Kind::kDecoupled) {
        DecoupledConfig decoupled;
        if (in.has("decoupled")) {
          ConfigReader section = in.child("decoupled");
          decoupled = DecoupledConfig::read(section);
        }
        return std::make_unique<DecoupledLaw>(robot, config, decoupled);
      }
      if (config.solver_thread) return std::make_unique<BackgroundMpcLaw>(robot, config);
      return std::make_unique<MpcLaw>(robot, config);
    }
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<ControlLaw> makeControlLaw(ConfigReader& in, const RobotParameters& robot) {
  try {
    return makeLaw(in, robot);
  } catch (const NumericalError& e) {
    throw InputError(fmt::format(
        "{}: no such law balances this robot: {}. Masses and lengths (in m) are in robot.urdf, the "
        "pose is robot.nominal_arm_rad or that of the set point, weights are in lqr and mpc",
        in.at("kind"), e.what()));
  }
}

}  // namespace ballbot
