#include "controller/law_factory.hpp"

#include "controller/background_mpc_law.hpp"
#include "controller/lqr_law.hpp"
#include "controller/mpc_law.hpp"
#include "core/config_reader.hpp"

namespace ballbot {
namespace {

LqrLawConfig readLqr(ConfigReader& in, const RobotParameters& robot) {
  ConfigReader lqr = in.child("lqr");
  return LqrLawConfig::read(lqr, robot);
}

}  // namespace

std::unique_ptr<ControlLaw> makeControlLaw(ConfigReader& in, const RobotParameters& robot) {
  enum class Kind { kLqr, kMpc };
  switch (in.choice<Kind>("kind", {{"lqr", Kind::kLqr}, {"mpc", Kind::kMpc}})) {
    case Kind::kLqr:
      return std::make_unique<LqrLaw>(robot, readLqr(in, robot));
    case Kind::kMpc: {
      ConfigReader mpc = in.child("mpc");
      MpcConfig config = MpcConfig::read(mpc, robot);
      if (in.has("lqr")) config.lqr = readLqr(in, robot);
      if (config.solver_thread) return std::make_unique<BackgroundMpcLaw>(robot, config);
      return std::make_unique<MpcLaw>(robot, config);
    }
  }
  return nullptr;
}

}  // namespace ballbot
