#include "experiment/scenario.hpp"

#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

std::string balance() {
  return std::string(BALLBOT_SOURCE_DIR) + "/configs/scenarios/balance.yaml";
}

TEST(Scenario, WrittenToARunFolderItReadsBackTheSame) {
  const fs::path folder =
      fs::temp_directory_path() / ("ballbot_scenario_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const Scenario scenario =
      loadScenario(balance(), {"duration_s=3.5", "plant.fidelity.friction=false"}, 42);
  writeScenario(scenario, folder.string());
  const Scenario again = loadScenario((folder / "scenario.yaml").string());
  EXPECT_EQ(again.configDigest(), scenario.configDigest());
  fs::remove_all(folder);
  EXPECT_EQ(again.duration, std::chrono::milliseconds(3500));
  EXPECT_EQ(again.seed, 42u);
  EXPECT_EQ(again.release, scenario.release);
  EXPECT_EQ(again.requirements.size(), scenario.requirements.size());
}

TEST(Scenario, TheDigestSeesEveryValue) {
  const std::string digest = loadScenario(balance()).configDigest();
  EXPECT_EQ(loadScenario(balance()).configDigest(), digest);
  for (const char* change :
       {"seed=2", "duration_s=9", "plant.fidelity.friction=false", "robot.gravity_m_per_s2=9.8"}) {
    EXPECT_NE(loadScenario(balance(), {change}).configDigest(), digest) << change;
  }
}

TEST(Scenario, TheDigestDoesNotDependOnWhereTheFileLies) {
  const fs::path here = fs::current_path();
  const std::string digest = loadScenario(balance()).configDigest();
  fs::current_path(fs::path(balance()).parent_path());
  const std::string nearby = loadScenario("balance.yaml").configDigest();
  fs::current_path(here);
  EXPECT_EQ(nearby, digest);
}

TEST(Scenario, ADirectoryIsNoScenario) {
  EXPECT_THROW(loadScenario(std::string(BALLBOT_SOURCE_DIR) + "/configs"), InputError);
}

}  // namespace
}  // namespace ballbot
