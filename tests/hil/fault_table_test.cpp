#include "hil/rehearsal/fault_table.hpp"

#include <set>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

void expectHeld(const FaultRow& row) {
  EXPECT_TRUE(row.held) << row.fault << ", " << toText(row.runner) << ": " << row.expected
                        << " within " << row.bound_cycles << ", came after " << row.measured_cycles
                        << " (" << row.check << ": " << row.reason << "), exit code "
                        << row.exit_code << (row.says_off ? ", says off" : ", does not say off")
                        << (row.torque_on ? ", torque is on" : "");
}

TEST(FaultTable, EveryFaultEndsAsItMustInBothRunners) {
  const std::vector<FaultRow> rows = rehearseFaults();
  std::set<std::string> faults;
  for (const FaultRow& row : rows) {
    faults.insert(row.fault);
    expectHeld(row);
  }
  EXPECT_GE(faults.size(), 80U);
  EXPECT_GE(rows.size(), 2 * faults.size() - 2) << "in both runners, but for what one cannot have";
}

TEST(FaultTable, IsTheSameEveryTime) {
  const auto a = rehearseFaults(), b = rehearseFaults();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].measured_cycles, b[i].measured_cycles) << a[i].fault;
    EXPECT_EQ(a[i].reason, b[i].reason) << a[i].fault << ", " << toText(a[i].runner);
    EXPECT_EQ(a[i].exit_code, b[i].exit_code) << a[i].fault << ", " << toText(a[i].runner);
  }
}

TEST(FaultTable, CombinationsOfFaultsEndInTimeOrAreSaid) {
  for (const FaultRow& row : rehearseRandomFaults(60, 1)) expectHeld(row);
}

}  // namespace
}  // namespace ballbot
