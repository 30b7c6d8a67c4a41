#pragma once

#include <vector>

#include "controller/control_law.hpp"
#include "controller/whole_body_cost.hpp"

namespace ballbot {

using MpcState = Eigen::Matrix<double, kMpcStateDim, 1>;
using MpcInput = Eigen::Matrix<double, kMpcInputDim, 1>;
using MpcGain = Eigen::Matrix<double, kMpcInputDim, kMpcStateDim>;

/// A plan as it is handed from solver to tracker: u(t) = u_ff(t) + K(t) (x - x_ff(t)), linear
/// between its samples, constant outside. States belong to the knots. Inputs and gains belong to
/// times of their own: an input held over a step stands in the step's middle, because interpolating
/// it between knots would lag by half a step.
class MpcPolicy {
 public:
  struct Knot {
    double time;  ///< since stamp [s]
    MpcState x;
    JointVector
        joint_position;  ///< wheels: integrated along the plan from the measured angle [rad]
    JointVector joint_velocity;  ///< [rad/s]

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.time);
      visit(self.x);
      visit(self.joint_position);
      visit(self.joint_velocity);
    }
  };
  struct Control {
    double time;  ///< since stamp [s]
    MpcInput u;
    MpcGain K;

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.time);
      visit(self.u);
      visit(self.K);
    }
  };

  MpcPolicy() = default;
  MpcPolicy(int knots, int controls) : knots_(knots), controls_(controls) {}

  bool valid() const { return valid_; }
  void setValid(SimTime stamp) {
    stamp_ = stamp;
    valid_ = true;
  }
  /// Time of the state the plan starts from.
  SimTime stamp() const { return stamp_; }
  std::vector<Knot>& knots() { return knots_; }
  const std::vector<Knot>& knots() const { return knots_; }
  std::vector<Control>& controls() { return controls_; }
  const std::vector<Control>& controls() const { return controls_; }

  /// Free of allocation; t in seconds since the stamp.
  MpcState stateAt(double t) const noexcept;
  void controlAt(double t, MpcInput& u, MpcGain& K) const noexcept;

  /// @param xf  filter state at `now`: its feedback joins the feedforward torque.
  void sample(SimTime now, const Vector3& xf, PolicySample& out) const noexcept;

  /// Joint set-points from the states, wheels starting at `joint_angle` (model.hpp's S(q) nu).
  void integrateJoints(const ReducedDynamics& dynamics, const JointVector& joint_angle) noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.valid_);
    visit(self.stamp_);
    visit.sameCount(self.knots_.size(), "knots of a plan");
    visit.sameCount(self.controls_.size(), "inputs of a plan");
    visit(self.knots_);
    visit(self.controls_);
  }

 private:
  bool valid_ = false;
  SimTime stamp_{};
  std::vector<Knot> knots_;
  std::vector<Control> controls_;
};

}  // namespace ballbot
