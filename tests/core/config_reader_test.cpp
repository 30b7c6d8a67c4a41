#include "core/config_reader.hpp"

#include <functional>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

/// The words of the InputError that `read` throws on `yaml`.
std::string errorOf(const std::string& yaml, const std::function<void(ConfigReader&)>& read) {
  const ConfigNode node = parseYaml(yaml, "sea.yaml");
  try {
    ConfigReader in(node);
    read(in);
    in.finish();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(ConfigReader, ReadsEveryType) {
  const ConfigNode node = parseYaml(
      "a: 1.5\nb: 3\nc: true\nd: text\ne: [1, 2, 3]\nf: fast\ng_us: 400\nh: {x: 1}\ni: [{y: 1}, "
      "{y: 2}]\n",
      "t");
  ConfigReader in(node);
  EXPECT_EQ(in.number("a"), 1.5);
  EXPECT_EQ(in.integer("b"), 3);
  EXPECT_TRUE(in.boolean("c"));
  EXPECT_EQ(in.text("d"), "text");
  EXPECT_EQ(in.numbers<3>("e"), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ((in.choice<int>("f", {{"slow", 1}, {"fast", 2}})), 2);
  EXPECT_EQ(in.duration("g_us"), std::chrono::microseconds(400));
  EXPECT_EQ(in.child("h").number("x"), 1);
  std::vector<ConfigReader> items = in.list("i");
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[1].number("y"), 2);
  EXPECT_NO_THROW(in.finish());
}

TEST(ConfigReader, TakesTheFallbackOnlyWhereTheKeyIsAbsent) {
  const ConfigNode node = parseYaml("a: 2", "t");
  ConfigReader in(node);
  EXPECT_EQ(in.numberOr("a", 7), 2);
  EXPECT_EQ(in.numberOr("b", 7), 7);
}

TEST(ConfigReader, NamesPlaceValueAndRange) {
  EXPECT_EQ(errorOf("x: 1\ntorque_limit_Nm: -4",
                    [](ConfigReader& in) {
                      in.number("x");
                      in.number("torque_limit_Nm", {0, 50});
                    }),
            "sea.yaml:2:18: torque_limit_Nm is -4, must be between 0 and 50");
  EXPECT_EQ(errorOf("mass_kg: 0",
                    [](ConfigReader& in) {
                      in.number("mass_kg", {kTiny, kInf});
                    }),
            "sea.yaml:1:10: mass_kg is 0, must be more than 0");
}

TEST(ConfigReader, RefusesNumbersThatAreNone) {
  const auto read = [](ConfigReader& in) { in.number("x"); };
  EXPECT_EQ(errorOf("x: abc", read), "sea.yaml:1:4: x is abc, must be a number");
  EXPECT_EQ(errorOf("x: \"1\"", read), "sea.yaml:1:4: x is \"1\", must be a number");
  EXPECT_EQ(errorOf("x: nan", read), "sea.yaml:1:4: x is not a number (NaN)");
  EXPECT_EQ(errorOf("x: inf", read), "sea.yaml:1:4: x is inf, must be finite");
  EXPECT_EQ(errorOf("x: [1]", read), "sea.yaml:1:4: x is a list, must be a number");
  EXPECT_EQ(errorOf("x: 1.5", [](ConfigReader& in) { in.integer("x"); }),
            "sea.yaml:1:4: x is 1.5, must be a whole number");
}

TEST(ConfigReader, GuessesTheKeyThatWasMeant) {
  EXPECT_EQ(
      errorOf("sprnig_stiffness: 3",
              [](ConfigReader& in) { in.number("spring_stiffness_Nm_per_rad"); }),
      "sea.yaml:1:19: unknown key 'sprnig_stiffness'; did you mean 'spring_stiffness_Nm_per_rad'?");
  EXPECT_EQ(errorOf("mass: 1\nmas: 2", [](ConfigReader& in) { in.number("mass"); }),
            "sea.yaml:2:6: unknown key 'mas'; did you mean 'mass'?");
  EXPECT_THAT(errorOf("zzzzzzzz: 1\nmass: 2", [](ConfigReader& in) { in.number("mass"); }),
              HasSubstr("unknown key 'zzzzzzzz'; known are: mass"));
}

TEST(ConfigReader, SaysWhichKeyIsMissingAndWhere) {
  EXPECT_EQ(errorOf("a: {b: 1}",
                    [](ConfigReader& in) {
                      ConfigReader a = in.child("a");
                      a.number("b");
                      a.number("c");
                    }),
            "sea.yaml:1:4: key 'c' is missing in 'a'");
}

TEST(ConfigReader, ListsTheChoices) {
  EXPECT_EQ(errorOf("mode: turbo",
                    [](ConfigReader& in) {
                      in.choice<int>("mode", {{"ideal", 0}, {"real", 1}});
                    }),
            "sea.yaml:1:7: mode is 'turbo', must be one of: ideal, real");
}

TEST(ConfigReader, CountsTheNumbersOfAList) {
  EXPECT_EQ(errorOf("p: [1, 2]", [](ConfigReader& in) { in.numbers<3>("p"); }),
            "sea.yaml:1:4: p has 2 values, must be a list of 3 numbers");
  EXPECT_EQ(errorOf("p: [1, x, 3]", [](ConfigReader& in) { in.numbers<3>("p"); }),
            "sea.yaml:1:8: p[1] is x, must be a number");
}

TEST(ConfigReader, RefusesPeriodsThatAreNotWholeNanoseconds) {
  EXPECT_THAT(
      errorOf("period_ms: 16.6666666666", [](ConfigReader& in) { in.duration("period_ms"); }),
      HasSubstr("not a whole number of nanoseconds"));
}

}  // namespace
}  // namespace ballbot
