#include <gmock/gmock.h>

#include "core/config_reader.hpp"
#include "estimator/estimator_registry.hpp"
#include "tests/estimator/support/smooth_motion.hpp"
#include "tests/plant/support/described_keys.hpp"

namespace ballbot::test {
namespace {

using ::testing::IsEmpty;

TEST(DescribeEstimator, TellsEveryKeyOfTheFilesThatShip) {
  const auto keys = described("estimator", describeEstimator);
  for (const std::string& file : shipped("estimators")) {
    const ConfigNode tree = loadYamlFile(file);
    EXPECT_THAT(undescribed(&tree, "estimator", keys), IsEmpty()) << file;
  }
  for (const std::string& file : shipped("scenarios")) {
    const ConfigNode tree = loadYamlFile(file);
    EXPECT_THAT(undescribed(tree.find("estimator"), "estimator", keys), IsEmpty()) << file;
  }
}

TEST(DescribeEstimator, TellsEachKeyInWordsAndWithItsDefault) {
  const auto keys = described("estimator", describeEstimator);
  expectWellDescribed(keys);
  ASSERT_FALSE(keys.empty());
  EXPECT_EQ(keys.front().path, "estimator.kind");
  EXPECT_EQ(keys.front().choices, (std::vector<std::string>{"complementary", "two_state"}));
}

// So that `kind` alone can be changed, either takes the keys of the other.
TEST(DescribeEstimator, TellsWhatEitherKindTakes) {
  for (const char* kind : {"complementary", "two_state"}) {
    ConfigNode tree = parseYaml(std::string("kind: ") + kind, "est.yaml");
    for (const KeyEntry& e : described("", describeEstimator)) {
      if (e.kind == KeyKind::kSection) {
        setPath(tree, e.path, ConfigNode::map({"est.yaml", 0, 0}));
      } else if (e.path != "kind") {
        setPath(tree, e.path, parseYaml(e.fallback, "est.yaml"));
      }
    }
    ConfigReader in(tree);
    EXPECT_NO_THROW(readEstimator(in)->make(estimatorTestRobot())) << kind;
  }
}

}  // namespace
}  // namespace ballbot::test
