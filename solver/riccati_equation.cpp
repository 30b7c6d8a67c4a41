#include <fmt/format.h>

#include "core/error.hpp"
#include "solver/riccati_equation_impl.hpp"

namespace ballbot {
namespace detail {

void noUsableSolution(double relative_residual) {
  throw NumericalError(fmt::format(
      "Riccati equation has no usable solution (relative residual {:.1e}): the inputs must reach "
      "every unstable mode, and the weights must see it",
      relative_residual));
}

}  // namespace detail
}  // namespace ballbot
