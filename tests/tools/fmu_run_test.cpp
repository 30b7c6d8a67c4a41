// FMUs in whole runs, through the executable.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/fmi/spring_support.hpp"
#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Summary of a short run of `balance`, which must come to its end.
nlohmann::json runOf(const std::string& out, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run",        scenarioPath("balance"), "--out",   out,
                                        "--set",      "duration_s=1.5",        "--quiet", "--json",
                                        "--no-report"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished run = runBallbot(arguments);
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << run.err;
  return json.is_discarded() ? nlohmann::json{{"trajectory_digest", run.err}} : json;
}
std::string digestOf(const std::string& out, const std::vector<std::string>& more) {
  return runOf(out, more)["trajectory_digest"];
}

TEST(FmuRun, OurOwnFmuAsThePlantGivesTheDigestOfTheNativePlant) {
  const TemporaryFolder folder;
  const std::vector<std::string> brief = {"--set", "duration_s=0.8"};  // released at 0.5 s
  const std::string native = digestOf(folder / "native", brief);
  for (const char* version : {"2", "3"}) {
    const std::string file = folder / (std::string("plant") + version + ".fmu");
    const Finished made =
        runBallbot({"fmu", "--fmi", version, "--scenario", scenarioPath("balance"), "-o", file});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const std::string fmus = "fmus=[{name: plant, file: '" + file + "'}]", run = folder / version;
    // Saved at 0.6 s, its processes killed, continued in new ones.
    EXPECT_EQ(
        digestOf(run, {"--set", "duration_s=0.8", "--set", fmus, "--replace-plant-at", "0.6"}),
        native);
    fs::remove(file);  // the run folder has its own
    const Finished checked = runBallbot({"check", run, "--quiet", "--in-process"});
    EXPECT_EQ(checked.out, "identical\n") << checked.err;
  }
}

// A push that an FMU gives is the push that the scenario schedules: all metrics agree to all
// digits.
TEST(FmuRun, APushByAnFmuIsThePushOfTheScenario) {
  const TemporaryFolder folder;
  const auto scheduled =
      runOf(folder / "scheduled", {"--in-process", "--set",
                                   "environment.pushes=[{body: base, point_m: [0, 0, 0], force_N: "
                                   "[0, 20, 0], start_s: 0.8, duration_s: 0.4}]"});
  const std::string fmus = "fmus=[{name: hand, file: '" + springFmu() +
                           "', parameters: {'push[2]': 20, push_start: 0.8, push_end: 1.2}, "
                           "connections: [{from: hand.push_force, to: plant.force.base_W}]}]";
  const auto imported = runOf(folder / "imported", {"--set", fmus});
  ASSERT_TRUE(scheduled.contains("metrics") && imported.contains("metrics"));
  EXPECT_GT(imported["metrics"]["largest_ball_excursion_m"].get<double>(), 0.05) << "it did push";
  for (const auto& [name, value] : imported["metrics"].items()) {
    if (name.find("push") != std::string::npos) continue;  // counted from the schedule
    EXPECT_EQ(value, scheduled["metrics"][name]) << name;
  }
}

TEST(FmuRun, AnFmuThatCrashesEndsTheRunInWordsAndLeavesItsRecord) {
  const TemporaryFolder folder;
  const std::string fmus = "fmus=[{name: door, file: '" + springFmu() +
                           "', parameters: {trouble: 1, trouble_time: 0.3}, "
                           "connections: [{from: door.force, to: plant.force.base_W}]}]";
  const Finished run = runBallbot(
      {"run", scenarioPath("balance"), "--quiet", "--out", folder / "run", "--set", fmus});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("FMU 'door'"));
  EXPECT_THAT(run.err, HasSubstr("its process ended when asked to step (signal 6, Aborted)"));
  EXPECT_GT(fs::file_size(folder / "run/run.lcmlog"), 10000U);
}

TEST(FmuRun, ADamagedFmuIsBadInputWhereverThePlantLivesAndLeavesNoFolder) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.fmu") << "PK, and then nothing of an archive";
  for (const bool in_process : {true, false}) {
    std::vector<std::string> arguments = {
        "run",     scenarioPath("balance"),
        "--quiet", "--no-report",
        "--out",   folder / "run",
        "--set",   "fmus=[{name: plant, file: " + folder / "bad.fmu" + "}]"};
    if (in_process) arguments.push_back("--in-process");
    const Finished run = runBallbot(arguments, 60);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr("bad.fmu: is not an archive that can be read"));
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  }
}

TEST(FmuRun, InfoTellsAboutAnybodysFmu) {
  const Finished text = runBallbot({"fmu", "--info", springFmu()});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("spring, FMI 2 for Co-Simulation"));
  EXPECT_THAT(text.out, HasSubstr("outputs that follow inputs at once: 3"));
  const auto json = nlohmann::json::parse(runBallbot({"fmu", "--info", springFmu(), "--json"}).out);
  EXPECT_EQ(json["variables"][0]["name"], "hand");
  EXPECT_EQ(json["variables"][0]["size"], 3);
  const Finished none = runBallbot({"fmu", "--info", scenarioPath("balance")});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("balance.yaml: is not an archive that can be read"));
}

}  // namespace
}  // namespace ballbot
