#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <hdf5.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

std::vector<double> readDataset(hid_t file, const char* name) {
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0)
      << name;
  H5Sclose(space);
  H5Dclose(dataset);
  return values;
}

std::string readUnit(hid_t file, const char* name) {
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT),
              attribute = H5Aopen(dataset, "unit", H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  std::string unit(H5Tget_size(type), '\0');
  H5Aread(attribute, type, unit.data());
  H5Tclose(type);
  H5Aclose(attribute);
  H5Dclose(dataset);
  return unit;
}

TEST(Export, CsvAndHdf5HoldTheSameNumbers) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      runBallbot({"run", scenarioPath("balance"), "--in-process", "--quiet", "--no-report", "--set",
                  "duration_s=0.6", "--set", "requirements={}", "--out", folder / "run"})
          .exit_code,
      0);
  const Finished exported = runBallbot(
      {"export", folder / "run", "--csv", folder / "csv", "--hdf5", folder / "run.h5", "--json"});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  const int rows = nlohmann::json::parse(exported.out)["rows"]["truth"];
  EXPECT_GT(rows, 200);

  const hid_t file = H5Fopen((folder / "run.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const std::vector<double> time = readDataset(file, "/truth/time_s"),
                            pitch = readDataset(file, "/truth/base_angles_pitch");
  EXPECT_EQ(readUnit(file, "/truth/base_angles_pitch"), "rad");
  EXPECT_EQ(readUnit(file, "/command/torque_arm2"), "N m");
  H5Fclose(file);
  ASSERT_EQ(time.size(), static_cast<std::size_t>(rows));

  std::ifstream csv((folder / "csv") + "/truth.csv");
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line.rfind("time_s,ball_position_W_x [m],ball_position_W_y [m],base_angles_yaw [rad],"
                       "base_angles_pitch [rad],",
                       0),
            0U)
      << line;
  for (std::size_t k = 0; std::getline(csv, line); ++k) {
    std::vector<double> cells;
    for (std::size_t at = 0; cells.size() < 5; at = line.find(',', at) + 1)
      cells.push_back(std::stod(line.substr(at)));
    ASSERT_EQ(cells[0], time[k]);
    ASSERT_EQ(cells[4], pitch[k]) << "numbers must survive the text";
  }
}

}  // namespace
}  // namespace ballbot
