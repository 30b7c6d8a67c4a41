// The sizes in which the controller uses the discrete solver, compiled once. Nothing else is
// compiled here: what else calls Eigen's matrix-vector product in one file decides how the compiler
// specialises it, and thereby the last bit of every plan.

#include "controller/cost_terms.hpp"
#include "controller/input_sizes.hpp"
#include "solver/slq_solver_impl.hpp"

namespace ballbot {

template struct ValueFunction<kMpcStateDim>;

#define BALLBOT_INSTANTIATE(NU)                                                         \
  template struct LqStage<kMpcStateDim, NU>;                                            \
  template bool riccatiStep<kMpcStateDim, NU>(const LqStage<kMpcStateDim, NU>&, double, \
                                              ValueFunction<kMpcStateDim>&,             \
                                              StageGain<kMpcStateDim, NU>&) noexcept;   \
  template class SlqSolver<kMpcStateDim, NU, CostTerms>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
