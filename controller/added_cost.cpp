// The cost of tasks that were added, in a file of its own: what stands beside the kernel of the
// others can change how it is compiled, and so its last bits.
#include "controller/whole_body_cost.hpp"

namespace ballbot {

template <bool kExpand>
void WholeBodyCost::addedCost(const StateVector& x, const Tasks& tasks, double share,
                              CostTerms& terms, StateExpansion* out) const {
  for (std::size_t i = 0; i < tasks.added->size(); ++i) {
    const TaskTarget& target = tasks.added_target[i];
    if (target.weight.isZero(0)) continue;
    Vector3 e = Vector3::Zero();
    TaskJacobian J;
    if constexpr (kExpand) J.setZero();
    (*tasks.added)[i]->residual(x, target.reference, e, kExpand ? &J : nullptr);
    terms.added[i] += 0.5 * share * target.weight.dot(e.cwiseAbs2());
    if constexpr (kExpand) {
      const TaskJacobian weighted = (share * target.weight).asDiagonal() * J;
      for (int c = 0; c < kStateDim; ++c) {
        out->g(c) += weighted.col(c).dot(e);
        for (int r = c; r < kStateDim; ++r) out->H(r, c) += weighted.col(c).dot(J.col(r));
      }
    }
  }
}

template void WholeBodyCost::addedCost<false>(const StateVector&, const Tasks&, double, CostTerms&,
                                              StateExpansion*) const;
template void WholeBodyCost::addedCost<true>(const StateVector&, const Tasks&, double, CostTerms&,
                                             StateExpansion*) const;

}  // namespace ballbot
