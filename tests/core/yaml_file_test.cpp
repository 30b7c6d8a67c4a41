#include "core/yaml_file.hpp"

#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/config_reader.hpp"
#include "core/config_values.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::string errorOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

std::string yamlError(const std::string& text) {
  return errorOf([&] { parseYaml(text, "t.yaml"); });
}

class Files : public ::testing::Test {
 protected:
  Files()
      : folder_(fs::temp_directory_path() / ("ballbot_yaml_file_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  fs::path folder_;
};

TEST(YamlText, WhatSaysMoreThanOneThingIsRefused) {
  EXPECT_EQ(yamlError("a: 1\n---\na: 2\n"),
            "t.yaml:2:1: a second document begins here ('---'); keep one");
  EXPECT_THAT(yamlError("a: &x 1\nb: 2"), HasSubstr("t.yaml:1:4: an anchor ('&name') is not read"));
  EXPECT_THAT(yamlError("a: {<<: {b: 1}}"),
              HasSubstr("t.yaml:1:5: a merge key ('<<') is not read"));
  EXPECT_THAT(yamlError("a: !!str 1"), HasSubstr("a tag ('tag:yaml.org,2002:str') is not read"));
  EXPECT_THAT(yamlError("[1, 2]: 3"), HasSubstr("a key must be a plain word"));
  EXPECT_THAT(yamlError("~: 3"), HasSubstr("a key must be a plain word"));
  EXPECT_EQ(yamlError("---\na: \"1\"\n..."), "no error") << "one document may say that it is one";
}

TEST(YamlText, DeepNestingIsRefusedNotFollowed) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "- ";
  EXPECT_THAT(yamlError(deep + "x"), HasSubstr("not valid YAML"));
}

TEST_F(Files, NullDropsWhatWasIncluded) {
  write("base.yaml", "requirements: {tilt: {below: 8}, drift: {below: 1}}\nseed: 1\n");
  const ConfigNode one =
      loadYamlFile(write("one.yaml", "include: base.yaml\nrequirements: {tilt: ~}\n"));
  EXPECT_EQ(one.find("requirements")->find("tilt"), nullptr);
  EXPECT_NE(one.find("requirements")->find("drift"), nullptr);
  const ConfigNode all =
      loadYamlFile(write("all.yaml", "include: base.yaml\nrequirements: null\n"));
  EXPECT_EQ(all.find("requirements"), nullptr);
  EXPECT_NE(all.find("seed"), nullptr);
}

TEST_F(Files, AnOverrideWithNullDropsAKey) {
  ConfigNode node = parseYaml("requirements: {tilt: {below: 8}, drift: {below: 1}}", "t");
  applyOverride(node, "requirements.tilt=null");
  EXPECT_EQ(toYaml(node), "requirements: \n  drift: \n    below: 1\n");
}

TEST_F(Files, AnOverrideMayIncludeAFile) {
  const std::string law = write("law.yaml", "kind: lqr\ngain: 2\n");
  ConfigNode node = parseYaml("controller: {kind: mpc, horizon: 1}", "t");
  applyOverride(node, "controller={include: " + law + ", gain: 3}");
  const ConfigNode& controller = *node.find("controller");
  EXPECT_EQ(controller.find("kind")->text(), "lqr");
  EXPECT_EQ(controller.find("gain")->text(), "3");
  EXPECT_EQ(controller.find("horizon"), nullptr) << "the value given replaces what was there";
  EXPECT_EQ(controller.find("kind")->where().source, law) << "paths in it are relative to it";
  EXPECT_THAT(errorOf([&] { applyOverride(node, "controller.include=" + law); }),
              HasSubstr("write e.g. --set 'controller={include: FILE}'"));
}

TEST_F(Files, AnIncludedFileThatIsNoMappingIsNamed) {
  const std::string top = write("top.yaml", "a: 1\npart: {include: part.yaml}\n");
  const std::string part = write("part.yaml", "- 1\n");
  EXPECT_THAT(
      errorOf([&] { loadYamlFile(top); }),
      HasSubstr("part.yaml:1:1: an included file must be a mapping of keys to values, not a list; "
                "it is included at " +
                top + ":2:17"));
  write("part.yaml", "");
  EXPECT_THAT(errorOf([&] { loadYamlFile(top); }),
              HasSubstr("part.yaml: an included file must be"));
}

TEST(FileNames, LeadNowhereElse) {
  const auto name = [](const std::string& yaml) {
    const ConfigNode node = parseYaml("name: " + yaml, "t.yaml");
    ConfigReader in(node);
    return readFileName(in, "name");
  };
  EXPECT_EQ(name("push 5N_v1.2"), "push 5N_v1.2");
  EXPECT_EQ(name("größer"), "größer");
  for (const char* bad :
       {"../../evil", "/tmp/x", "a/b", "..", ".hidden", "-rf", "\"\"", "\"a\\nb\""}) {
    EXPECT_THAT(errorOf([&] { name(bad); }), HasSubstr("must be the name of a file")) << bad;
  }
}

TEST(WholeNumbers, AreNotCutToSize) {
  const auto seed = [](const std::string& yaml) {
    const ConfigNode node = parseYaml("seed: " + yaml, "t.yaml");
    ConfigReader in(node);
    return readWhole(in, "seed", {0, 1e15});
  };
  EXPECT_EQ(seed("012"), 12);
  EXPECT_EQ(seed("123456789012345"), 123456789012345);
  EXPECT_EQ(errorOf([&] { seed("1.5"); }), "t.yaml:1:7: seed is 1.5, must be a whole number");
  EXPECT_EQ(errorOf([&] { seed("+-1"); }), "t.yaml:1:7: seed is +-1, must be a number");
  EXPECT_EQ(errorOf([&] { seed("0x10"); }), "t.yaml:1:7: seed is 0x10, must be a number");
}

TEST(Durations, BeyondWhatTimeCanHoldAreRefused) {
  const ConfigNode node = parseYaml("period_ms: 1e300", "t.yaml");
  EXPECT_THAT(errorOf([&] { ConfigReader(node).duration("period_ms"); }),
              HasSubstr("at most 292 years"));
}

}  // namespace
}  // namespace ballbot
