// What connections may call the variables of somebody's FMU, and what may be given to them.
#include "fmi/fmu_ports.hpp"

#include <chrono>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "fmi/array_element.hpp"
#include "tests/fmi/small_fmus.hpp"

namespace ballbot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string wordsOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "not refused";
}

TEST(ArrayElement, CountsRowByRow) {
  EXPECT_EQ(elementOffset("2", {3}), 1U);
  EXPECT_EQ(elementOffset("0", {3}, 0), 0U);
  EXPECT_EQ(elementOffset("1,2", {3, 3}), 1U);
  EXPECT_EQ(elementOffset("2,1", {3, 3}), 3U);
  EXPECT_EQ(elementOffset("2,3,4", {2, 3, 4}), 23U);
  EXPECT_EQ(elementOffset("9", {3, 3}), 8U);
  for (const char* none : {"0", "4", "2x", "x", "", "+1", "-1", "01", " 1", "1 ", "1,2", "1,", ",1",
                           "1.5", "99999999999999999999"}) {
    EXPECT_FALSE(elementOffset(none, {3})) << none;
  }
  EXPECT_FALSE(elementOffset("1,4", {3, 3}));
  EXPECT_FALSE(elementOffset("10", {3, 3}));
}

TEST(FmuPorts, ScalarsAreARowIfNumberedWithoutGapsFromOneOrZero) {
  const auto fmu = readFmuDescription(fmi2File(
      "rows", scalar("one[2]") + scalar("one[1]") + scalar("zero[0]") + scalar("zero[1]") +
                  scalar("hole[1]") + scalar("hole[3]") + scalar("late[2]") + scalar("odd[01]")));
  EXPECT_EQ(findPort(fmu, "one").size, 2);
  EXPECT_EQ(findPort(fmu, "one").variables[0].name, "one[1]");
  EXPECT_EQ(findPortOf(fmu, "zero[0]").name, "zero");
  EXPECT_EQ(findPortOf(fmu, "zero[0]").first_index, 0U);
  EXPECT_EQ(findPortOf(fmu, "hole[3]").name, "hole[3]");
  EXPECT_EQ(findPortOf(fmu, "late[2]").name, "late[2]");
  EXPECT_EQ(findPortOf(fmu, "odd[01]").name, "odd[01]");
  EXPECT_THAT(wordsOf([&] { findPort(fmu, "hole"); }), HasSubstr("'hole' is no row"));
  EXPECT_THAT(wordsOf([&] { findPortOf(fmu, "hole[2]"); }), HasSubstr("no variable 'hole[2]'"));
}

TEST(FmuPorts, AnExactNameWinsAndRowsAreOfOneKind) {
  const auto fmu = readFmuDescription(
      fmi2File("mixed", scalar("p[1]", "parameter") + scalar("p[2]") + scalar("t[1]") +
                            scalar("t[2]", "input", "Integer") + scalar("k", "parameter") +
                            scalar("k[1]") + scalar("k[2]") + scalar("q.'y [N]'", "output")));
  EXPECT_EQ(findPortOf(fmu, "p[2]").name, "p[2]");
  EXPECT_EQ(findPortOf(fmu, "p[2]").first().role, VariableRole::kInput);
  EXPECT_EQ(findPortOf(fmu, "t[2]").size, 1);
  EXPECT_EQ(findPort(fmu, "k").first().role, VariableRole::kParameter);
  EXPECT_EQ(findPortOf(fmu, "k[2]").name, "k[2]");
  EXPECT_EQ(findPortOf(fmu, "q.'y [N]'").name, "q.'y [N]'");
  EXPECT_THAT(wordsOf([&] { readFmuDescription(fmi2File("twice", scalar("a") + scalar("a"))); }),
              HasSubstr("two variables have the name 'a'"));
}

TEST(FmuPorts, ArraysOfFmi3HaveAliasesAndSizesThatAreKnown) {
  const auto fmu = readFmuDescription(fmi3File(
      "arrays",
      "<Float64 name=\"u\" causality=\"input\" valueReference=\"1\"><Dimension start=\"2\"/>"
      "<Dimension start=\"3\"/><Alias name=\"hand.x\"/></Float64>"
      "<Float64 name=\"open\" valueReference=\"2\"><Dimension valueReference=\"7\"/></Float64>"
      "<Float64 name=\"vast\" valueReference=\"3\"><Dimension start=\"65536\"/>"
      "<Dimension start=\"65536\"/></Float64>"
      "<Float64 name=\"less\" valueReference=\"4\"><Dimension start=\"-3\"/></Float64>"));
  const FmuPort port = findPortOf(fmu, "hand.x[2,3]");
  EXPECT_EQ(port.name, "u");
  EXPECT_THAT(port.aliases, ElementsAre("hand.x"));
  EXPECT_THAT(port.dimensions, ElementsAre(2U, 3U));
  EXPECT_EQ(port.size, 6);
  for (const char* name : {"open", "vast", "less"}) {
    EXPECT_THAT(wordsOf([&] { findPortOf(fmu, name); }), HasSubstr("is not fixed")) << name;
  }
}

TEST(FmuTypes, OnlyWhatLosesNothingFits) {
  using K = ValueKind;
  for (const K kind : {K::kReal, K::kInteger, K::kBoolean, K::kEnumeration}) {
    EXPECT_TRUE(fitsWithoutLoss(kind, kind));
    EXPECT_TRUE(fitsWithoutLoss(kind, K::kReal));
    EXPECT_FALSE(fitsWithoutLoss(kind, K::kOther));
  }
  EXPECT_TRUE(fitsWithoutLoss(K::kBoolean, K::kInteger));
  EXPECT_FALSE(fitsWithoutLoss(K::kReal, K::kInteger));
  EXPECT_FALSE(fitsWithoutLoss(K::kReal, K::kBoolean));
  EXPECT_FALSE(fitsWithoutLoss(K::kInteger, K::kBoolean));
  EXPECT_FALSE(fitsWithoutLoss(K::kInteger, K::kEnumeration));
}

TEST(FmuTypes, ValuesThatATypeDoesNotHoldAreRefused) {
  const auto refusal = [](const char* type, double value) {
    ImportedVariable v;
    v.facts = &fmuType(type);
    return refusalOf(v, value);
  };
  EXPECT_EQ(refusal("Int8", -128), "");
  EXPECT_EQ(refusal("Int8", 128), "must be a whole number between -128 and 127");
  EXPECT_EQ(refusal("UInt32", 4294967295.0), "");
  EXPECT_NE(refusal("UInt32", -1), "");
  EXPECT_NE(refusal("Integer", 3.7), "");
  EXPECT_NE(refusal("Integer", 1e20), "");
  EXPECT_NE(refusal("Int64", 1e16), "");
  EXPECT_NE(refusal("Int32", std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(refusal("Boolean", 1), "");
  EXPECT_NE(refusal("Boolean", 2), "");
  EXPECT_NE(refusal("Boolean", 0.5), "");
  EXPECT_EQ(refusal("Float32", 0.1), "");
  EXPECT_NE(refusal("Float32", 1e300), "");
  ImportedVariable mode;
  mode.facts = &fmuType("Enumeration");
  mode.items = std::make_shared<const std::vector<double>>(std::vector<double>{1, 2, 5});
  EXPECT_EQ(refusalOf(mode, 5), "");
  EXPECT_EQ(refusalOf(mode, 3), "must be one of the numbers of its enumeration: 1, 2, 5");
}

TEST(FmuDescription, TextThatIsNoUtf8IsReadAsLatin1) {
  const auto fmu = readFmuDescription(fmi2File("latin", scalar("gr\xf6\xdf"
                                                               "e")));
  EXPECT_EQ(fmu.variables.front().name, "gr\u00f6\u00dfe");
}

// The time for a row grew with the cube of its length, and that for outputs with their square.
TEST(FmuDescription, TakesLinearTime) {
  std::string row, outputs, structure;
  constexpr int kCount = 20'000;
  for (int i = 1; i <= kCount; ++i) {
    row += scalar("u[" + std::to_string(i) + "]", "input", "Real declaredType=\"T\"", i);
    outputs += "<Float64 name=\"y" + std::to_string(i) +
               "\" causality=\"output\" valueReference=\"" + std::to_string(i) + "\"/>";
    structure += "<Output valueReference=\"" + std::to_string(i) + "\" dependencies=\"\"/>";
  }
  std::string types = "<TypeDefinitions>";
  for (int i = 0; i < kCount; ++i) types += "<SimpleType name=\"T" + std::to_string(i) + "\"/>";
  types += "<SimpleType name=\"T\"><Real unit=\"m\"/></SimpleType></TypeDefinitions>";
  const auto start = std::chrono::steady_clock::now();
  const auto two = readFmuDescription(fmi2File("long", row, types));
  EXPECT_EQ(allPorts(two).size(), 1U);
  EXPECT_EQ(findPort(two, "u").size, kCount);
  const auto three = readFmuDescription(
      fmi3File("many", outputs, "<ModelStructure>" + structure + "</ModelStructure>"));
  EXPECT_EQ(allPorts(three).size(), static_cast<std::size_t>(kCount));
  EXPECT_FALSE(three.variables.back().depends_on_all);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(FmuDescription, TooMuchIsRefusedInWords) {
  const std::string blanks(std::size_t{129} << 20, ' ');
  EXPECT_THAT(wordsOf([&] { readFmuDescription(fmi2File("blanks", blanks)); }),
              HasSubstr("'modelDescription.xml' unpacks to 129 MiB, must be 128 MiB at most"));
  std::string elements;
  for (int i = 0; i < 12'000'001; ++i) elements += "<a/>";
  EXPECT_THAT(wordsOf([&] { readFmuDescription(fmi2File("elements", elements)); }),
              HasSubstr("elements and attributes, must be 12000000 at most"));
}

}  // namespace
}  // namespace ballbot
