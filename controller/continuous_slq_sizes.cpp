// The sizes in which the controller uses the continuous-time solver, compiled once.

#include "controller/cost_terms.hpp"
#include "controller/mpc_dimensions.hpp"
#include "solver/continuous_slq_impl.hpp"

namespace ballbot {

template class ContinuousSlq<kMpcStateDim, kJointCount, CostTerms>;
template class ContinuousSlq<kMpcStateDim, kJointCount + 3, CostTerms>;
template class ContinuousSlq<kMpcStateDim, kJointCount + 6, CostTerms>;

}  // namespace ballbot
