// The sizes in which the controller uses the continuous-time solver, compiled once.

#include "controller/cost_terms.hpp"
#include "controller/input_sizes.hpp"
#include "solver/continuous_slq_impl.hpp"

namespace ballbot {

#define BALLBOT_INSTANTIATE(NU) template class ContinuousSlq<kMpcStateDim, NU, CostTerms>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
