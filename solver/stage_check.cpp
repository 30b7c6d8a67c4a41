#include "solver/stage_check.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

void requireStages(int made_for, int given) {
  if (made_for == given) return;
  throw InputError(fmt::format(
      "the solver was made for {} stages, its problem has {}. Make it with the problem's stages(), "
      "or on a grid of one knot more",
      made_for, given));
}

}  // namespace ballbot
