#pragma once

#include "solver/slq_solver.hpp"

namespace ballbot {

/// @throw InputError with both numbers unless a solver that is `made_for` so many stages fits a
/// problem that has `given`.
void requireStages(int made_for, int given);

/// At set-up: a solver writes where its problem says it has stages, and iterations check nothing.
/// @throw InputError if the solver was made for another number of stages.
template <int NX, int NU, typename Cost>
void requireFits(SlqSolver<NX, NU, Cost>& solver,
                 const OptimalControlProblem<NX, NU, Cost>& problem) {
  requireStages(static_cast<int>(solver.nominal().u.size()), problem.stages());
}

}  // namespace ballbot
