#include "controller/decoupled_law.hpp"
#include "controller/law_kinds.hpp"
#include "controller/mpc_settings.hpp"

namespace ballbot {
namespace {

class DecoupledSettings final : public MpcSettings {
 public:
  DecoupledSettings(ConfigReader& controller, const RobotParameters& robot)
      : MpcSettings(controller, robot) {
    if (!controller.has("decoupled")) return;
    ConfigReader section = controller.child("decoupled");
    decoupled_ = DecoupledConfig::read(section);
  }

  std::unique_ptr<ControlLaw> makeLaw() const override {
    return std::make_unique<DecoupledLaw>(robot(), config(), decoupled_);
  }
  std::unique_ptr<ControlLaw> makeLawAtRest(SimTime) const override { return makeLaw(); }
  /// Its arm minimises nothing, and integrates what no analysis of a loop knows of.
  std::optional<QuadraticCost> costAt(SimTime, const ArmVector&) const override {
    return std::nullopt;
  }

 private:
  DecoupledConfig decoupled_;
};

}  // namespace

LawKind decoupledKind() {
  return {"decoupled",
          {lqrSection(),
           mpcSection(),
           {may("decoupled", "settings of the arm where it is controlled apart from the base"),
            [](ConfigVisitor& v, const RobotParameters&) { DecoupledConfig().describe(v); }}},
          [](ConfigReader& in, const RobotParameters& robot) -> std::unique_ptr<LawSettings> {
            return std::make_unique<DecoupledSettings>(in, robot);
          }};
}

}  // namespace ballbot
