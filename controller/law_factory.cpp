#include "controller/law_factory.hpp"

#include <fmt/format.h>

#include "controller/background_mpc_law.hpp"
#include "controller/decoupled_law.hpp"
#include "controller/lqr_law.hpp"
#include "controller/mpc_law.hpp"
#include "controller/pd_tracker.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

enum class Kind { kLqr, kMpc, kDecoupled };

void describeKind(ConfigVisitor& v, Kind& kind) {
  v.choice(must("kind",
                "which law balances the robot: the LQR, the whole-body MPC, or an MPC of the "
                "base with the arm controlled apart"),
           kind, {{"lqr", Kind::kLqr}, {"mpc", Kind::kMpc}, {"decoupled", Kind::kDecoupled}});
}

LqrLawConfig readLqr(ConfigReader& in, const RobotParameters& robot) {
  ConfigReader lqr = in.child("lqr");
  return LqrLawConfig::read(lqr, robot);
}

std::unique_ptr<ControlLaw> makeLaw(ConfigReader& in, const RobotParameters& robot) {
  Kind kind = Kind::kLqr;
  ConfigReading reading(in);
  describeKind(reading, kind);
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

void describeKnownPayload(ConfigVisitor& v, double& payload) {
  v.number(may("known_payload_kg",
               "mass in the robot's hand that estimator and law count on; by "
               "default the one of the robot's own description"),
           payload, {0, 5});
}

void describeController(ConfigVisitor& v, const RobotParameters& robot) {
  Kind kind = Kind::kMpc;
  double known_payload = robot.payload_mass;
  TrackerConfig tracker = TrackerConfig::defaults(robot);
  LqrLawConfig lqr = LqrLawConfig::defaults(robot);
  MpcConfig mpc(robot);
  DecoupledConfig decoupled;
  describeKind(v, kind);
  describeKnownPayload(v, known_payload);
  v.section(must("tracker", "follows the law's plan, at the highest rate"),
            [&](ConfigVisitor& in) { tracker.describe(in); });
  v.section(
      may("lqr",
          "the LQR, needed by the kind lqr; beside an MPC it seeds the first plan and takes over "
          "when plans fail"),
      [&](ConfigVisitor& in) { lqr.describe(in); });
  v.section(may("mpc", "the MPC, needed by the kinds mpc and decoupled"),
            [&](ConfigVisitor& in) { mpc.describe(in); });
  v.section(may("decoupled", "settings of the arm where it is controlled apart from the base"),
            [&](ConfigVisitor& in) { decoupled.describe(in); });
}

}  // namespace ballbot
