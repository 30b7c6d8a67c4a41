// `ballbot explain`, the reference of keys and the schema: all from what the configuration structs
// tell of themselves.
#include <fstream>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

TEST(Explain, SaysWordsTypeUnitAndDefaultOfAKey) {
  const Finished flag = runBallbot({"explain", "plant.fidelity.friction"});
  EXPECT_EQ(flag.exit_code, 0) << flag.err;
  EXPECT_THAT(flag.out, HasSubstr("plant.fidelity.friction\n"));
  EXPECT_THAT(flag.out, HasSubstr("true or false"));
  EXPECT_THAT(flag.out, HasSubstr("default true"));
  const Finished number =
      runBallbot({"explain", "robot.actuators.wheel.spring_stiffness_Nm_per_rad"});
  EXPECT_THAT(number.out, HasSubstr("number, above 0 [N m/rad]"));
  EXPECT_THAT(number.out, HasSubstr("must be there"));
}

TEST(Explain, ListsWhatLiesBelowAMapping) {
  const Finished tasks = runBallbot({"explain", "controller.mpc.tasks"});
  EXPECT_EQ(tasks.exit_code, 0) << tasks.err;
  EXPECT_THAT(tasks.out, HasSubstr("ee_position"));
  EXPECT_THAT(tasks.out, HasSubstr("preview"));
  const Finished all = runBallbot({"explain"});
  EXPECT_THAT(all.out, HasSubstr("duration_s"));
  EXPECT_THAT(all.out, HasSubstr("controller"));
}

TEST(Explain, NamesTheNearestOfAKeyThatIsNone) {
  const Finished f = runBallbot({"explain", "plant.fidelity.fricton"});
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("did you mean 'plant.fidelity.friction'?"));
  const Finished elsewhere = runBallbot({"explain", "torque_bandwidth_Hz"});
  EXPECT_EQ(elsewhere.exit_code, 2);
  EXPECT_THAT(elsewhere.err, HasSubstr("robot.actuators.wheel.torque_bandwidth_Hz"));
}

/// Dotted paths of all that a YAML tree read as JSON has, items of lists as 0.
void paths(const Json& node, const std::string& path, std::set<std::string>& out) {
  if (node.is_object()) {
    for (const auto& [key, value] : node.items()) {
      const std::string name = path.empty() ? key : path + "." + key;
      out.insert(name);
      paths(value, name, out);
    }
  }
}

TEST(Explain, TheSchemaFileIsWhatTheProgramSays) {
  const Finished f = runBallbot({"explain", "--schema"});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  const Json schema = Json::parse(f.out);
  const Json& contact =
      schema["properties"]["plant"]["properties"]["fidelity"]["properties"]["contact"];
  EXPECT_EQ(contact["enum"][0], "rolling");
  EXPECT_EQ(schema["properties"]["plant"]["additionalProperties"], false);
  std::stringstream file;
  file << std::ifstream(std::string(BALLBOT_SOURCE_DIR) + "/configs/scenario.schema.json").rdbuf();
  EXPECT_EQ(file.str(), f.out) << "write it anew: ballbot explain --schema > "
                                  "configs/scenario.schema.json";
  std::set<std::string> all;
  paths(schema, "", all);
  EXPECT_GT(all.size(), 500U);
}

TEST(Explain, HasEachKeyOnceAsJson) {
  const Finished f = runBallbot({"explain", "--json"});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  std::set<std::string> keys;
  for (const Json& entry : Json::parse(f.out)) {
    EXPECT_TRUE(keys.insert(entry["key"].get<std::string>()).second) << entry["key"];
    EXPECT_GE(entry["words"].get<std::string>().size(), 8U) << entry["key"];
  }
  EXPECT_GT(keys.size(), 200U);
}

}  // namespace
}  // namespace ballbot
