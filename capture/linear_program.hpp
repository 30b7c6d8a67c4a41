#pragma once

#include <memory>
#include <vector>

namespace ballbot {

/// A linear program: numbers between bounds, sums of them between bounds, one of them as large as
/// can be. Solved by Clp (COIN-OR), which no other file knows. Equal programs give equal bits.
class LinearProgram {
 public:
  struct Term {
    int variable = 0;
    double factor = 0;
  };

  LinearProgram();
  ~LinearProgram();
  LinearProgram(const LinearProgram&) = delete;
  LinearProgram& operator=(const LinearProgram&) = delete;

  /// A number between two bounds, which may be infinite. @return what to call it in a Term
  int addVariable(double low, double high);
  /// low <= sum of factor * variable <= high; each variable stands once in it.
  void addRow(double low, double high, const std::vector<Term>& terms);

  int variableCount() const;
  int rowCount() const;

  /// The largest value that `variable` can have.
  /// @throw NumericalError if no numbers keep all bounds, if it can grow without end, or if the
  ///        solver gives up; the text says which.
  double largest(int variable);

 private:
  struct Rows;
  std::unique_ptr<Rows> rows_;
};

}  // namespace ballbot
