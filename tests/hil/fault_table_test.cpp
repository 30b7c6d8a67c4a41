#include "hil/rehearsal/fault_table.hpp"

#include <set>
#include <vector>

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

/// The answers of one or two cycles are held back and come with those of the next one, as from an
/// adapter that stalls now and then.
TEST(FaultTable, AnswersOfSeveralCyclesAtOnceAreNoTwins) {
  Rehearsal rehearsal(Rehearsal::defaultConfig(), RunnerKind::kStepped);
  ASSERT_TRUE(rehearsal.engage()) << rehearsal.why();
  int cycle = 0;
  std::vector<CanFrame> held;
  rehearsal.wire(0).onWayToMaster([&](const CanFrame& f, std::vector<CanFrame>& out) {
    const std::uint32_t function = f.id & 0x780U;
    const bool answer = function >= 0x180 && function <= 0x480 && (function & 0x80U) != 0;
    if (answer && (cycle == 60 || cycle == 70 || cycle == 71 || cycle == 80))
      return held.push_back(f);
    out.insert(out.end(), held.begin(), held.end());
    held.clear();
    out.push_back(f);
  });
  for (; cycle < 120; ++cycle) {
    BenchCommand command;
    for (std::size_t i = 0; i < command.torque.size(); ++i) {
      command.torque[i] = 0.2 + 0.001 * ((7 * cycle + static_cast<int>(i)) % 13);
    }
    rehearsal.cycle(&command);
  }
  EXPECT_FALSE(rehearsal.ended()) << rehearsal.why();
}

}  // namespace
}  // namespace ballbot
