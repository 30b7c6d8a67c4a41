// A sensor, a task and a control law that stand in one file each, outside of the program: a run
// with them is recorded, exported, reported, and the sensor is a variable of the FMU.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/error.hpp"
#include "experiment/log_tables.hpp"
#include "experiment/run_experiment.hpp"
#include "experiment/text_file.hpp"
#include "fmi/model_description.hpp"
#include "fmi/plant_fmu.hpp"
#include "tests/seams/additions.hpp"

namespace ballbot::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kScenario = BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml";
constexpr double kHeated_s = 2;

/// All additions, once for the process.
class Seams : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    addDriveThermometer();
    addLeanTask();
    addGentleLaw();
  }
  Seams() : base_(fs::temp_directory_path() / ("ballbot_seams_" + std::to_string(::getpid()))) {}
  ~Seams() override { fs::remove_all(base_); }

  RunResult run(const std::string& name, std::vector<std::string> changes,
                RunOptions options = {}) {
    changes.push_back("duration_s=2");
    changes.push_back("plant.added_sensors={drive_thermometer: {time_constant_s: 20}}");
    options.in_process = true;
    return runExperiment(loadScenario(kScenario, changes), (base_ / name).string(), options);
  }
  static std::vector<std::string> columnNames(const LogTable& table) {
    std::vector<std::string> out;
    for (const LogTable::Column& column : table.columns) out.push_back(column.name);
    return out;
  }

  fs::path base_;
};

const std::string kTasks = "controller.mpc.tasks.lean={weight: 3}";
const std::string kFrames =
    "controller.mpc.tasks.frames=[{name: elbow, body: arm_2, position: {weight: 2}}, "
    "{name: base, body: base, orientation: {weight: 1}}]";

TEST_F(Seams, ARunWithSensorAndTasksIsRecordedAndReported) {
  const RunResult result = run("tasks", {kTasks, kFrames});
  const std::vector<LogTable> tables = logTables(readRunLog(result.folder.logFile()));
  EXPECT_FALSE(result.fell);

  const LogTable& sensors = *findTable(tables, "sensors");
  const std::vector<double>& t = sensors.column("time_s");
  const std::vector<double>& temperature = sensors.column("temperature_arm2");
  ASSERT_EQ(temperature.size(), t.size());
  EXPECT_EQ(temperature.front(), 293);
  // While the stand holds the robot and after, joint 2 holds the forearm with a torque that hardly
  // changes: the closed form of the warming, by the torque that the log has.
  const std::vector<double>& torque = findTable(tables, "truth")->column("joint_torque_arm2");
  double mean_square = 0;
  for (const double v : torque) mean_square += v * v / static_cast<double>(torque.size());
  const double expected = 0.5 * mean_square * (1 - std::exp(-kHeated_s / 20));
  EXPECT_NEAR(temperature.back() - 293, expected, 0.1 * expected);
  EXPECT_GT(expected, 0.01) << "nothing was warmed, so nothing was tested";

  const LogTable& plan = *findTable(tables, "plan");
  EXPECT_THAT(columnNames(plan), Contains("cost_lean"));
  EXPECT_THAT(columnNames(plan), Contains("cost_elbow_position"));
  EXPECT_THAT(columnNames(plan), Contains("cost_base_orientation"));
  double largest = 0;
  for (const double v : plan.column("cost_lean")) largest = std::max(largest, v);
  EXPECT_GT(largest, 0);
  // The whole is the sum of its parts, those that were added among them.
  double sum = 0;
  for (const LogTable::Column& c : plan.columns) {
    if (c.name.rfind("cost_", 0) == 0) sum += c.values[5];
  }
  EXPECT_NEAR(sum, plan.column("cost")[5], 1e-9 * (1 + sum));

  const std::string report = readTextFile(result.folder.reportFile());
  EXPECT_THAT(report, HasSubstr("Added sensors"));
  EXPECT_THAT(report, HasSubstr("temperature_wheel1"));
}

TEST_F(Seams, TheTaskIsFollowed) {
  const auto leanAt = [&](const std::string& name, const std::string& task) {
    const RunResult result = run(name, {task, "controller.mpc.tasks.yaw.weight=0"});
    return findTable(logTables(readRunLog(result.folder.logFile())), "truth")
        ->column("base_angles_pitch")
        .back();
  };
  // The ball must run away to lean on, so only a part of what is asked for is reached.
  const double plain = leanAt("plain", "controller.mpc.tasks.lean={weight: 0}");
  const double asked = leanAt(
      "asked",
      "controller.mpc.tasks.lean={weight: 2000, reference: {moves: [{at_s: 1, by: [0.05, 0]}]}}");
  EXPECT_GT(asked - plain, 0.01) << "rad";
}

TEST_F(Seams, ALawOfOnesOwnBalancesAndRecords) {
  const RunResult result =
      run("law", {"controller.kind=gentle", "controller.gentle={share_of_gain: 0.9}"});
  EXPECT_FALSE(result.fell);
  const LogTable plan = *findTable(logTables(readRunLog(result.folder.logFile())), "plan");
  EXPECT_THAT(columnNames(plan), Contains("value_of_state"));
  EXPECT_GT(plan.column("value_of_state")[3], 0);
}

TEST_F(Seams, TheSameScenarioGivesTheSameBytes) {
  const RunResult once = run("once", {kTasks}), again = run("again", {kTasks});
  EXPECT_EQ(once.trajectory_digest, again.trajectory_digest);
  EXPECT_EQ(once.log_digest, again.log_digest);
  RunOptions options;  // saved, thrown away, and continued from what was saved
  options.replace_plant_at = kSimStart + durationFromSeconds(1.2);
  EXPECT_EQ(run("replaced", {kTasks}, options).trajectory_digest, once.trajectory_digest);
}

TEST_F(Seams, WhatNobodyAddedIsRefusedByName) {
  const auto said = [](const std::string& change) -> std::string {
    try {
      readRunConfig(loadScenario(kScenario, {change}));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(said("plant.added_sensors={thermometer: {}}"), HasSubstr("drive_thermometer"));
  EXPECT_THAT(said("controller.mpc.tasks.leen={weight: 1}"), HasSubstr("'lean'"));
  EXPECT_THAT(said("controller.kind=gentel"), HasSubstr("gentle"));
  EXPECT_THAT(
      said("controller.mpc.tasks.frames=[{name: ee, body: base, position: {weight: 1}}]"),
      HasSubstr("'cost_ee_position' is added to the table 'plan' of a run, which has such"));
  EXPECT_THAT(said("controller.mpc.tasks.frames=[{name: a b, body: base, position: {weight: 1}}]"),
              HasSubstr("a name must be of letters"));
  EXPECT_THAT(said("controller.mpc.tasks.frames=[{name: a, body: arm_9, position: {weight: 1}}]"),
              HasSubstr("arm_2"));
  EXPECT_THAT(said("controller.mpc.tasks.frames=[{name: a, body: base, position: {weight: 1}}, "
                   "{name: a, body: arm_1, position: {weight: 1}}]"),
              HasSubstr("two tasks are called 'a_position'"));
}

TEST_F(Seams, TheSensorIsAVariableOfTheFmu) {
  Scenario scenario =
      loadScenario(kScenario, {"plant.added_sensors={drive_thermometer: {ambient_K: 300}}"});
  fs::create_directories(base_);
  writeScenario(scenario, base_.string());
  const std::string yaml = readTextFile((base_ / "scenario.yaml").string());
  const std::string urdf = readTextFile((base_ / "robot.urdf").string());
  PlantFmu fmu(base_.string(), fmuToken(yaml, urdf, 3), 3);
  EXPECT_THAT(fmi3ModelDescription(fmu.variables(), {}), HasSubstr("sensors.temperature_wheel2"));

  ValueReference reference = 0;
  for (const FmuVariable& v : fmu.variables().all()) {
    if (v.name == "sensors.temperature_arm2") reference = v.reference;
  }
  ASSERT_GT(reference, 0u);
  fmu.setTimes(0, std::nullopt);
  fmu.enterInitialization();
  fmu.exitInitialization();
  EXPECT_EQ(fmu.value(reference), 300);
  fmu.doStep(0, 0.1);
  EXPECT_GT(fmu.value(reference), 300);
}

}  // namespace
}  // namespace ballbot::test
