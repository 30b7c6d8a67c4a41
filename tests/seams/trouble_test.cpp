// A law, a sensor and a task of somebody's own that go wrong are named, in process as elsewhere.
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <unistd.h>

#include "controller/added_task.hpp"
#include "controller/law_registry.hpp"
#include "core/error.hpp"
#include "experiment/run_experiment.hpp"
#include "plant/added_sensors.hpp"
#include "plant/plant.hpp"

namespace ballbot::test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Thrower final : LawSettings {
  using LawSettings::LawSettings;
  std::unique_ptr<ControlLaw> makeLaw() const override { throw std::out_of_range("no gain table"); }
};

/// Reads `good`, and after a second NaN.
struct Gauge final : AddedSensorSettings {
  struct Sensor final : AddedSensor {
    Sensor() : AddedSensor(1) {}
    void reset(const TruthFrame&) override { state()[0] = 0; }
    void advance(const TruthFrame&, SimDuration since) override { state()[0] += toSeconds(since); }
    void read(double* values) const override { values[0] = state()[0] < 1 ? 7 : kNan; }
  };
  void describe(ConfigVisitor&) override {}
  std::vector<AddedSignal> signals() const override { return {{"gauge", "", "breaks"}}; }
  std::unique_ptr<AddedSensor> make(std::uint64_t) const override {
    return std::make_unique<Sensor>();
  }
};

/// Not finite as soon as something is asked of it.
struct Fragile final : AddedTaskOf<1> {
  using AddedTaskOf::AddedTaskOf;
  void residual(const StateVector& x, const Vector3& reference, Vector3& e,
                TaskJacobian* J) const noexcept override {
    e[0] = reference[0] == 0 ? x[kPitch] : kNan;
    if (J) (*J)(0, kPitch) = 1;
  }
};

class Trouble : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    lawKinds().add({"thrower", {}, [](ConfigReader&, const RobotParameters& robot) {
                      return std::make_unique<Thrower>(robot);
                    }});
    sensorKinds().add({"gauge", "breaks after a second", [] { return std::make_shared<Gauge>(); }});
    taskKinds().add(
        {"fragile", "breaks when it is used", [](const RobotParameters&, const StateVector&) {
           return std::make_shared<Fragile>("fragile", Eigen::Matrix<double, 1, 1>(0));
         }});
  }
  Trouble()
      : base_(fs::temp_directory_path() / ("ballbot_trouble_" + std::to_string(::getpid()))) {}
  ~Trouble() override { fs::remove_all(base_); }

  static Scenario scenario(std::vector<std::string> changes) {
    changes.push_back("duration_s=1.5");
    return loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml", changes);
  }
  RunResult run(const std::vector<std::string>& changes) {
    RunOptions options;
    options.in_process = true;
    options.write_report = false;
    return runExperiment(scenario(changes), (base_ / "run").string(), options);
  }
  template <typename Kind = InputError>
  std::string said(const std::vector<std::string>& changes) {
    try {
      run(changes);
    } catch (const Kind& e) {
      return e.what();
    }
    return "nothing";
  }

  fs::path base_;
};

TEST_F(Trouble, ALawThatThrowsIsNamedWithItsPlace) {
  const std::string words = said({"controller.kind=thrower"});
  EXPECT_THAT(words, HasSubstr("kind: the law 'thrower': no gain table"));
}

TEST_F(Trouble, ASensorThatIsNotFiniteIsNamed) {
  EXPECT_THAT(said<NumericalError>({"plant.added_sensors={gauge: {}}"}),
              HasSubstr("added sensor 'gauge': gauge is nan"));
}

TEST_F(Trouble, AStateWithOtherSensorsIsRefusedByTheirNames) {
  const auto plantOf = [](const Scenario& s) {
    return std::make_unique<Plant>(readPlantConfig(s.tree));
  };
  const auto bare = plantOf(scenario({}));
  const auto gauged = plantOf(scenario({"plant.added_sensors={gauge: {}}"}));
  for (Plant* plant : {bare.get(), gauged.get()}) plant->reset(kSimStart);
  try {
    bare->restoreState(gauged->saveState());
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("added sensors gauge; this one has"));
  }
}

TEST_F(Trouble, ATaskThatIsNotFiniteIsNamed) {
  const std::string asked = "controller.mpc.tasks.fragile={weight: 1, reference: ";
  EXPECT_THAT(said({asked + "{initial: [1]}}"}), HasSubstr("the residual of this task"));
  const RunResult result = run({asked + "{moves: [{at_s: 1, by: [1]}]}}"});
  EXPECT_EQ(result.plan_trouble, "cost of the task 'fragile' is not finite");
  EXPECT_GT(result.metrics.at("plans_refused"), 0);
}

}  // namespace
}  // namespace ballbot::test
