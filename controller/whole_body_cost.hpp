#pragma once

#include "controller/constraints.hpp"
#include "controller/cost_terms.hpp"
#include "controller/orientation_error.hpp"
#include "controller/tasks.hpp"
#include "controller/terminal_cost.hpp"
#include "model/reduced_dynamics.hpp"
#include "solver/riccati.hpp"

namespace ballbot {

/// Where a cost adds its second-order expansion in the robot's state: lower triangle and gradient
/// inside a column-major augmented matrix [H g; g^T *] of an LqStage or a ValueFunction.
struct StateExpansion {
  double* W;         ///< aligned to 32 bytes
  int stride;        ///< between columns, a multiple of 4
  int gradient_row;  ///< row of g^T

  double& H(int row, int column) { return W[column * stride + row]; }
  double& g(int i) { return W[i * stride + gradient_row]; }
};

/// The same for the inputs (tau, force, moment): H is diagonal but for the force's 3 x 3 block.
struct InputExpansion {
  Eigen::Matrix<double, kJointCount + kContactDim, 1> gradient, diagonal;
  Matrix3 force_hessian;
};

/// The running cost of Minniti et al. 2019, eq. 8-10: tasks as weighted squares, inequalities as
/// relaxed barriers. State part and input part are separate, so that discrete and continuous
/// solvers can weigh them by their own quadrature. Everything is multiplied by `share` (a length of
/// time) and added. Hessians are Gauss-Newton where residuals are curved: positive semidefinite.
class WholeBodyCost {
 public:
  using EndEffectorLinearization = ReducedDynamics::EndEffectorLinearization;

  /// @throw NumericalError as LqrTerminalCost, if that is the terminal cost.
  WholeBodyCost(const RobotParameters& robot, const Constraints& constraints,
                const TerminalCost& terminal = {});
  const Constraints& constraints() const { return constraints_; }

  void addState(const StateVector& x, const Tasks& tasks, double share, CostTerms& terms) const;
  void expandState(const StateVector& x, const Tasks& tasks, double share, CostTerms& terms,
                   StateExpansion out) const;
  /// The same for those who have linearised the end-effector at x already.
  void expandState(const StateVector& x, const EndEffectorLinearization& tip, const Tasks& tasks,
                   double share, CostTerms& terms, StateExpansion out) const;

  /// The end of a horizon: `share` of the state's cost rate as before, and the terminal cost. The
  /// expansion overwrites `value`, whole and symmetric.
  void addFinal(const StateVector& x, const Tasks& tasks, double share, CostTerms& terms) const;
  void expandFinal(const StateVector& x, const Tasks& tasks, double share, CostTerms& terms,
                   ValueFunction<kMpcStateDim>& value) const;

  /// All of the input cost but the wheel torques' own squares, which frequency shaping takes over.
  /// Without contact the force costs |lambda|^2 / 2 and moves nothing: it stays zero. So does the
  /// moment without a task of its own.
  void addInput(const JointVector& tau, const ContactInput& contact, const Tasks& tasks,
                double share, CostTerms& terms) const;
  /// Overwrites `out`.
  void expandInput(const JointVector& tau, const ContactInput& contact, const Tasks& tasks,
                   double share, CostTerms& terms, InputExpansion& out) const;

 private:
  template <bool kExpand>
  void endEffectorCost(const ReducedDynamics::EndEffector& tip,
                       const EndEffectorLinearization* by_x, const Tasks& tasks, double share,
                       CostTerms& terms, StateExpansion* out) const;
  template <bool kExpand>
  void coordinateCost(const StateVector& x, const Tasks& tasks, double share, CostTerms& terms,
                      StateExpansion* out) const;
  template <bool kExpand>
  void armLimitCost(const StateVector& x, const Tasks& tasks, double share, CostTerms& terms,
                    StateExpansion* out) const;
  template <bool kExpand>
  void wheelRateLimitCost(const StateVector& x, double share, CostTerms& terms,
                          StateExpansion* out) const;
  template <bool kExpand>
  void tiltLimitCost(const StateVector& x, double share, CostTerms& terms,
                     StateExpansion* out) const;
  template <bool kExpand>
  void addedCost(const StateVector& x, const Tasks& tasks, double share, CostTerms& terms,
                 StateExpansion* out) const;
  template <bool kExpand>
  void stateCost(const StateVector& x, const ReducedDynamics::EndEffector& tip,
                 const EndEffectorLinearization* by_x, const Tasks& tasks, double share,
                 CostTerms& terms, StateExpansion* out) const;
  template <bool kExpand>
  void inputCost(const JointVector& tau, const ContactInput& contact, const Tasks& tasks,
                 double share, CostTerms& terms, InputExpansion* out) const;
  template <bool kExpand>
  void forceCost(const Vector3& lambda_C, const Tasks& tasks, double share, CostTerms& terms,
                 InputExpansion* out) const;

  ReducedDynamics dynamics_;
  Matrix3 axles_;               ///< rows d_i
  double ball_radius_, ratio_;  ///< r [m], r / r_w
  Constraints constraints_;
  TerminalCost terminal_;
  std::shared_ptr<const LqrTerminalCost> lqr_value_;  ///< null unless the terminal cost is it
  double sin_tilt_limit_, cos_tilt_limit_;
};

}  // namespace ballbot
