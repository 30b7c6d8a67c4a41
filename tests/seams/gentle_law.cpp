// A control law: state feedback at the origin with a share of the LQR's gain.
#include "controller/law_registry.hpp"
#include "controller/lqr.hpp"
#include "core/state_visitors.hpp"
#include "tests/seams/additions.hpp"

namespace ballbot::test {
namespace {

class GentleLaw final : public ControlLaw {
 public:
  GentleLaw(const RobotParameters& robot, double share)
      : lqr_(designLqr(ReducedDynamics(robot), robot.nominal_arm, LqrWeights())), share_(share) {}

  PlanReport plan(SimTime, const StateVector& x, const JointVector& joint_angle) noexcept override {
    PlanReport report;
    policy_.x = lqr_.equilibrium.x;
    policy_.torque = lqr_.equilibrium.tau;
    policy_.feedback = share_ * gainAtYaw(lqr_.K, x[kYaw]);
    policy_.joint_position = joint_angle;
    const StateVector error = x - policy_.x;
    report.terms.added[0] = 0.5 * error.dot(lqr_.P * error);
    return report;
  }
  void activatePlan() noexcept override {}
  void sample(SimTime, PolicySample& out) const noexcept override { out = policy_; }
  void commanded(SimTime, SimDuration, const JointVector&) noexcept override {}

  StateBlob saveState() const override { return saveStateOf(policy_, "gentle_law", 1); }
  void restoreState(const StateBlob& blob) override {
    restoreStateOf(policy_, blob, "gentle_law", 1);
  }

 private:
  LqrSolution lqr_;
  double share_;
  PolicySample policy_;
};

class GentleSettings final : public LawSettings {
 public:
  GentleSettings(const RobotParameters& robot, double share) : LawSettings(robot), share_(share) {}

  std::unique_ptr<ControlLaw> makeLaw() const override {
    return std::make_unique<GentleLaw>(robot(), share_);
  }
  std::vector<AddedSignal> addedToPlan() const override {
    return {{"value_of_state", "", "what the LQR expects the rest of the run to cost"}};
  }

 private:
  double share_;
};

void describe(ConfigVisitor& v, double& share) {
  v.number(may("share_of_gain", "of the LQR's feedback"), share, {0.1, 2});
}

}  // namespace

void addGentleLaw() {
  lawKinds().add({"gentle",
                  {{must("gentle", "a law with a share of the LQR's gain"),
                    [](ConfigVisitor& v, const RobotParameters&) {
                      double share = 1;
                      describe(v, share);
                    }}},
                  [](ConfigReader& in, const RobotParameters& robot) {
                    double share = 1;
                    ConfigReader section = in.child("gentle");
                    ConfigReading reading(section);
                    describe(reading, share);
                    section.finish();
                    return std::make_unique<GentleSettings>(robot, share);
                  }});
}

}  // namespace ballbot::test
