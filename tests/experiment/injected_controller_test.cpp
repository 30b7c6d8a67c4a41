// A controller of one's own in the built-in one's place: master, recorder, metrics and verdict work
// with it as they do with ours.
#include <filesystem>

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/state_visitors.hpp"
#include "experiment/run_experiment.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Lets go: no torque, and counts how often it was asked.
class Idle final : public SteppedController {
 public:
  explicit Idle(EventCalendar& calendar)
      : task_(calendar.addTask("idle", std::chrono::milliseconds(2), {}, "the test's period")) {}

  std::string name() const override { return "idle"; }
  void onSensors(SimTime, const SensorFrame&, DueTasks due, ControlOutput& out) noexcept override {
    if (due.has(task_)) ++asked_[0];
    out.command.torque.setZero();
  }
  StateBlob saveState() const override { return saveStateOf(asked_, "idle", 1); }
  void restoreState(const StateBlob& blob) override { restoreStateOf(asked_, blob, "idle", 1); }
  std::map<std::string, double> metrics() const override { return {{"times_asked", asked_[0]}}; }
  std::vector<std::string> metricNames() const override { return {"times_asked"}; }

 private:
  TaskId task_;
  std::vector<double> asked_ = {0};
};

class InjectedController : public ::testing::Test {
 protected:
  InjectedController()
      : folder_(fs::temp_directory_path() / ("ballbot_injected_" + std::to_string(::getpid()))) {}
  ~InjectedController() override { fs::remove_all(folder_); }

  RunResult run(const std::string& requirements) {
    RunOptions options;
    options.in_process = true;
    options.write_report = false;
    options.make_controller = [](const RunConfig&, EventCalendar& calendar) {
      return std::make_unique<Idle>(calendar);
    };
    return runExperiment(loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml",
                                      {"requirements=" + requirements, "initial.release_s=0.5"}),
                         folder_.string(), options);
  }
  fs::path folder_;
};

TEST_F(InjectedController, IsRunRecordedAndJudged) {
  const RunResult result = run("{fell: {above: 0}, times_asked: {above: 100}}");
  EXPECT_TRUE(result.fell) << "nobody balances a robot that gets no torque";
  EXPECT_TRUE(result.passed) << "and the requirements ask for that";
  EXPECT_GT(toSeconds(result.end), 0.5);
  EXPECT_LT(toSeconds(result.end), 3);
  EXPECT_EQ(result.metrics.count("plans"), 0u) << "that is what the built-in controller counts";
  EXPECT_NEAR(result.metrics.at("times_asked"), toSeconds(result.end) / 0.002, 2);
  EXPECT_FALSE(result.trajectory_digest.empty());
}

TEST_F(InjectedController, MayNotBeAskedForWhatItDoesNotCount) {
  try {
    run("{plans_refused: {below: 1}}");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("plans_refused"));
  }
  EXPECT_FALSE(fs::exists(folder_)) << "nothing is left of a run that never was";
}

}  // namespace
}  // namespace ballbot
