#include "controller/law_kinds.hpp"
#include "controller/lqr_law.hpp"

namespace ballbot {
namespace {

class LqrSettings final : public LawSettings {
 public:
  LqrSettings(const RobotParameters& robot, const LqrLawConfig& config)
      : LawSettings(robot), config_(config) {}

  std::unique_ptr<ControlLaw> makeLaw() const override {
    return std::make_unique<LqrLaw>(robot(), config_);
  }
  std::unique_ptr<ControlLaw> makeLawAtRest(SimTime) const override {
    LqrLawConfig resting = config_;
    resting.set_point = LqrLawConfig::defaults(robot()).set_point;
    return std::make_unique<LqrLaw>(robot(), resting);
  }
  std::optional<QuadraticCost> costAt(SimTime, const ArmVector&) const override {
    QuadraticCost cost{config_.weights.stateWeight(), config_.weights.torqueWeight(), {}};
    cost.shaping.pole = cost.shaping.zero;
    return cost;
  }

 private:
  LqrLawConfig config_;
};

}  // namespace

LawSection lqrSection() {
  return {may("lqr",
              "the LQR, needed by the kind lqr; beside an MPC it seeds the first plan and takes "
              "over when plans fail"),
          [](ConfigVisitor& v, const RobotParameters& robot) {
            LqrLawConfig::defaults(robot).describe(v);
          }};
}

LawKind lqrKind() {
  return {"lqr",
          {lqrSection()},
          [](ConfigReader& in, const RobotParameters& robot) -> std::unique_ptr<LawSettings> {
            ConfigReader lqr = in.child("lqr");
            return std::make_unique<LqrSettings>(robot, LqrLawConfig::read(lqr, robot));
          }};
}

}  // namespace ballbot
