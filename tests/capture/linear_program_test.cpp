#include "capture/linear_program.hpp"

#include <limits>

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

// Dantzig's textbook shape: a corner of a polygon. x + 2y <= 14, 3x - y >= 0, x - y <= 2.
TEST(LinearProgram, FindsTheCornerThatIsFurthest) {
  LinearProgram p;
  const int x = p.addVariable(-kNoEnd, kNoEnd), y = p.addVariable(-kNoEnd, kNoEnd);
  const int value = p.addVariable(-kNoEnd, kNoEnd);
  p.addRow(-kNoEnd, 14, {{x, 1}, {y, 2}});
  p.addRow(0, kNoEnd, {{x, 3}, {y, -1}});
  p.addRow(-kNoEnd, 2, {{x, 1}, {y, -1}});
  p.addRow(0, 0, {{x, 3}, {y, 4}, {value, -1}});
  EXPECT_NEAR(p.largest(value), 34, 1e-9);  // at (6, 4)
  EXPECT_EQ(p.rowCount(), 4);
  EXPECT_EQ(p.variableCount(), 3);
}

TEST(LinearProgram, KeepsTheBoundsOfItsVariables) {
  LinearProgram p;
  const int x = p.addVariable(-3, 2.5);
  EXPECT_NEAR(p.largest(x), 2.5, 1e-12);
}

std::string refusal(LinearProgram& p, int variable) {
  try {
    p.largest(variable);
  } catch (const NumericalError& e) {
    return e.what();
  }
  return "";
}

TEST(LinearProgram, SaysWhetherNothingFitsOrNothingBounds) {
  LinearProgram narrow;
  const int x = narrow.addVariable(0, 1), y = narrow.addVariable(0, 1);
  narrow.addRow(3, kNoEnd, {{x, 1}, {y, 1}});
  EXPECT_THAT(refusal(narrow, x), HasSubstr("no numbers keep all of its bounds"));
  LinearProgram open;
  const int a = open.addVariable(0, kNoEnd), b = open.addVariable(0, kNoEnd);
  open.addRow(0, 1, {{a, 1}, {b, -1}});
  EXPECT_THAT(refusal(open, a), HasSubstr("nothing bounds what is to be largest"));
}

}  // namespace
}  // namespace ballbot
