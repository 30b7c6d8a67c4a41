#include "capture/linear_program.hpp"

#include <cmath>

#include <ClpSimplex.hpp>
#include <ClpSolve.hpp>
#include <CoinPackedMatrix.hpp>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

/// As Clp takes them: the matrix as a list of entries.
struct LinearProgram::Rows {
  std::vector<double> low, high, row_low, row_high, factors;
  std::vector<int> row_of, column_of;
};

namespace {

double bound(double value) {
  return std::isfinite(value) ? value : std::copysign(COIN_DBL_MAX, value);
}

}  // namespace

LinearProgram::LinearProgram() : rows_(std::make_unique<Rows>()) {}
LinearProgram::~LinearProgram() = default;

int LinearProgram::addVariable(double low, double high) {
  rows_->low.push_back(bound(low));
  rows_->high.push_back(bound(high));
  return variableCount() - 1;
}

void LinearProgram::addRow(double low, double high, const std::vector<Term>& terms) {
  const int row = rowCount();
  rows_->row_low.push_back(bound(low));
  rows_->row_high.push_back(bound(high));
  for (const Term& t : terms) {
    if (t.factor == 0) continue;
    rows_->row_of.push_back(row);
    rows_->column_of.push_back(t.variable);
    rows_->factors.push_back(t.factor);
  }
}

int LinearProgram::variableCount() const { return static_cast<int>(rows_->low.size()); }
int LinearProgram::rowCount() const { return static_cast<int>(rows_->row_low.size()); }

double LinearProgram::largest(int variable) {
  CoinPackedMatrix matrix(true, rows_->row_of.data(), rows_->column_of.data(),
                          rows_->factors.data(), static_cast<int>(rows_->factors.size()));
  matrix.setDimensions(rowCount(), variableCount());
  std::vector<double> objective(rows_->low.size(), 0);
  objective[static_cast<std::size_t>(variable)] = 1;

  ClpSimplex simplex;
  simplex.setLogLevel(0);
  simplex.loadProblem(matrix, rows_->low.data(), rows_->high.data(), objective.data(),
                      rows_->row_low.data(), rows_->row_high.data());
  simplex.setOptimizationDirection(-1);  // largest
  ClpSolve how;
  how.setSolveType(ClpSolve::useDual);
  how.setPresolveType(ClpSolve::presolveOn);
  simplex.initialSolve(how);
  if (simplex.isProvenOptimal()) return simplex.objectiveValue();
  const char* why = simplex.isProvenPrimalInfeasible() ? "no numbers keep all of its bounds"
                    : simplex.isProvenDualInfeasible() ? "nothing bounds what is to be largest"
                                                       : "the solver gave up";
  throw NumericalError(
      fmt::format("a linear program of {} rows and {} variables has no solution: {}", rowCount(),
                  variableCount(), why));
}

}  // namespace ballbot
