// The sizes of the controller's algebraic Riccati equations, compiled once.

#include "controller/mpc_dimensions.hpp"
#include "solver/riccati_equation_impl.hpp"

namespace ballbot {

#define BALLBOT_INSTANTIATE(N)                                                \
  template Eigen::Matrix<double, N, N> solveContinuousRiccati<N>(             \
      const Eigen::Matrix<double, N, N>&, const Eigen::Matrix<double, N, N>&, \
      const Eigen::Matrix<double, N, N>&);                                    \
  template double continuousRiccatiResidual<N>(                               \
      const Eigen::Matrix<double, N, N>&, const Eigen::Matrix<double, N, N>&, \
      const Eigen::Matrix<double, N, N>&, const Eigen::Matrix<double, N, N>&);
BALLBOT_INSTANTIATE(kStateDim)
BALLBOT_INSTANTIATE(kStateDim - 2 * kArmJointCount)  // of a robot whose arm is rigid
BALLBOT_INSTANTIATE(kMpcStateDim)                    // with the wheels' shaping filters
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
