#include "experiment/log_tables.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

TEST(LogTables, EachColumnHoldsItsOwnField) {
  RunLog log;
  log.truth.resize(2);
  for (int k = 0; k < 2; ++k) {
    auto& m = log.truth[static_cast<std::size_t>(k)];
    m.time = simTimeFromNs(k * 5'000'000);
    for (int i = 0; i < 8; ++i) m.state[i] = 10 * k + i;
    for (int i = 0; i < 6; ++i) m.joint_torque[i] = 100 * k + i;
    for (int i = 0; i < 3; ++i) m.contact_force_W[i] = -i - k;
  }
  const auto tables = logTables(log);
  ASSERT_EQ(tables.size(), 1u) << "channels without messages make no table";
  const LogTable& truth = *findTable(tables, "truth");
  EXPECT_EQ(truth.rowCount(), 2u);
  EXPECT_EQ(truth.column("time_s"), (std::vector<double>{0, 0.005}));
  EXPECT_EQ(truth.column("base_angles_pitch"), (std::vector<double>{3, 13}));
  EXPECT_EQ(truth.column("joint_torque_arm3"), (std::vector<double>{5, 105}));
  EXPECT_EQ(truth.column("contact_force_W_z"), (std::vector<double>{-2, -3}));
  EXPECT_THROW(truth.column("beauty"), InputError);
  EXPECT_EQ(findTable(tables, "sensors"), nullptr);
}

}  // namespace
}  // namespace ballbot
