#include "hil/rehearsal/fault_table.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(FaultTable, EveryFaultEndsWithoutTorqueWithinItsBound) {
  const std::vector<FaultRow> rows = rehearseFaults();
  EXPECT_GE(rows.size(), 20U);
  for (const FaultRow& row : rows) {
    EXPECT_TRUE(row.held) << row.fault << ": " << row.expected << " within " << row.bound_cycles
                          << ", came after " << row.measured_cycles << " (" << row.reason << ")"
                          << (row.restarted ? " and torque came back" : "");
  }
}

TEST(FaultTable, IsTheSameEveryTime) {
  const auto a = rehearseFaults(), b = rehearseFaults();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].measured_cycles, b[i].measured_cycles) << a[i].fault;
    EXPECT_EQ(a[i].reason, b[i].reason);
  }
}

}  // namespace
}  // namespace ballbot
