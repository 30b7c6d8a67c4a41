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

/// What the file in configs/ should be.
Json schemaOf(const std::string& kind) {
  const Finished f = runBallbot({"explain", "--file", kind, "--schema"});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  const std::string name = "configs/" + kind + ".schema.json";
  std::stringstream file;
  file << std::ifstream(std::string(BALLBOT_SOURCE_DIR) + "/" + name).rdbuf();
  EXPECT_EQ(file.str(), f.out) << "write it anew: ballbot explain --file " << kind << " --schema > "
                               << name;
  return Json::parse(f.out);
}

TEST(Explain, TheSchemaFileIsWhatTheProgramSays) {
  const Json schema = schemaOf("scenario");
  const Json& contact =
      schema["properties"]["plant"]["properties"]["fidelity"]["properties"]["contact"];
  EXPECT_EQ(contact["enum"][0], "rolling");
  EXPECT_EQ(schema["properties"]["plant"]["additionalProperties"], false);
  std::set<std::string> all;
  paths(schema, "", all);
  EXPECT_GT(all.size(), 500U);
}

TEST(Explain, BenchFilesAndStudiesHaveTheirsToo) {
  const Json bench = schemaOf("bench")["properties"];
  EXPECT_EQ(bench["drives"]["items"]["properties"]["torque_limit_Nm"]["exclusiveMinimum"], 0);
  EXPECT_TRUE(bench["emulator"]["properties"]["rig"]["properties"].contains("elastic"));
  const Json study = schemaOf("study")["properties"];
  EXPECT_EQ(study["design"]["enum"][1], "latin_hypercube");
  const Finished ramp = runBallbot({"explain", "--file", "bench", "safety.ramp_ms"});
  EXPECT_THAT(ramp.out, HasSubstr("default 100"));
  const Finished none = runBallbot({"explain", "--file", "study", "search.rat"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("no study has a key 'search.rat'; did you mean 'search.rate'?"));
}

std::set<std::string> keysOf(const std::string& kind, std::size_t fewest_letters) {
  const Finished f = runBallbot({"explain", "--file", kind, "--json"});
  EXPECT_EQ(f.exit_code, 0) << f.err;
  std::set<std::string> keys;
  for (const Json& entry : Json::parse(f.out)) {
    EXPECT_TRUE(keys.insert(entry["key"].get<std::string>()).second) << entry["key"];
    EXPECT_GE(entry["words"].get<std::string>().size(), fewest_letters) << entry["key"];
  }
  return keys;
}

TEST(Explain, HasEachKeyOnceAsJson) {
  EXPECT_GT(keysOf("scenario", 8).size(), 200U);
  EXPECT_GT(keysOf("bench", 4).size(), 120U);
  EXPECT_GT(keysOf("study", 4).size(), 25U);
}

}  // namespace
}  // namespace ballbot
