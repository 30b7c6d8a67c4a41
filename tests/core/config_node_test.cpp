#include "core/config_node.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class YamlFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ballbot_yaml_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  fs::path folder_;
};

std::string errorOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(ConfigNode, WritesYamlThatReadsBackTheSame) {
  const ConfigNode node = parseYaml(
      "a: 1\nb: {c: [1, -2.5e-3], d: \"1\", e: 'it: \"#\\'}\nf: [{g: 1, h: []}, {g: {}}]\nn: "
      "~\nneg: -.5\n",
      "t");
  const std::string once = toYaml(node);
  EXPECT_EQ(toYaml(parseYaml(once, "t")), once);
  ConfigReader in(node);
  const ConfigNode again = parseYaml(once, "t");
  ConfigReader back(again);
  EXPECT_EQ(back.child("b").text("e"), in.child("b").text("e"));
  EXPECT_TRUE(again.find("b")->find("d")->quoted());
}

TEST(ConfigNode, WritesKeysThatYamlWouldTakeForSomethingElse) {
  ConfigNode parameters = ConfigNode::map({});
  for (const char* key : {"'k #1: gain'",
                          "*k",
                          "gr\u00f6\u00dfe",
                          "null",
                          "NULL",
                          "~",
                          "? q",
                          "- d",
                          "a: b",
                          "",
                          "&x",
                          "!t",
                          "<<",
                          "---",
                          "...",
                          "-",
                          "{",
                          "[1",
                          "\"",
                          "\\",
                          "a\nb",
                          "1e3",
                          "true"}) {
    parameters.set(key, ConfigNode::scalar("2", false, {}));
  }
  ConfigNode tree = ConfigNode::map({});
  tree.set("parameters", parameters);
  const ConfigNode again = parseYaml(toYaml(tree), "t");
  ASSERT_EQ(again.find("parameters")->entries().size(), parameters.entries().size());
  for (const auto& [key, value] : parameters.entries()) {
    EXPECT_TRUE(again.find("parameters")->find(key)) << key << " in " << toYaml(tree);
  }
}

/// Trees of every form, from texts that are hard on a writer.
class RandomTrees {
 public:
  ConfigNode tree(int depth) {
    const int kind = depth == 0 ? 1 : static_cast<int>(random_() % 4);
    if (kind == 0) return ConfigNode::null({});
    if (kind == 1) return scalar();
    ConfigNode node = kind == 2 ? ConfigNode::map({}) : ConfigNode::list({});
    for (std::size_t n = random_() % 4; n > 0; --n) {
      if (kind == 2) {
        node.set(text(), tree(depth - 1));
      } else {
        node.append(tree(depth - 1));
      }
    }
    return node;
  }

 private:
  ConfigNode scalar() {
    // A bare text is one that a file can have bare: a word, a number.
    if (random_() % 2 == 0) return ConfigNode::scalar(text(), true, {});
    static const char* const bare[] = {"1",   "-2.5e-3", "-.5",  "+3",  "-inf",
                                       "a/b", "true",    "0x1F", "word"};
    return ConfigNode::scalar(bare[random_() % std::size(bare)], false, {});
  }
  std::string text() {
    static const char* const parts[] = {
        "a",      "7",      " ",      ":",          "#",    "'",    "\"",     "\\",
        "\n",     "\t",     "-",      "*",          "&",    "[",    "]",      "{",
        "}",      ",",      "?",      "|",          ">",    "%",    "@",      "`",
        "!",      "~",      "null",   "\r",         "\x01", "\x7f", "\u00e9", "\u0085",
        "\u00a0", "\u2028", "\ufeff", "\U0001F916", ".",    "<<",   "="};
    std::string out;
    for (std::size_t n = random_() % 6; n > 0; --n) out += parts[random_() % std::size(parts)];
    return out;
  }
  std::mt19937 random_{1};
};

void expectSame(const ConfigNode& a, const ConfigNode& b, const std::string& text) {
  ASSERT_EQ(a.kind(), b.kind()) << text;
  ASSERT_EQ(a.text(), b.text()) << text;
  ASSERT_EQ(a.quoted(), b.quoted()) << text;
  ASSERT_EQ(a.entries().size(), b.entries().size()) << text;
  ASSERT_EQ(a.items().size(), b.items().size()) << text;
  for (std::size_t i = 0; i < a.entries().size(); ++i) {
    ASSERT_EQ(a.entries()[i].first, b.entries()[i].first) << text;
    expectSame(a.entries()[i].second, b.entries()[i].second, text);
  }
  for (std::size_t i = 0; i < a.items().size(); ++i) expectSame(a.items()[i], b.items()[i], text);
}

TEST(ConfigNode, WriterAndParserAreInverse) {
  RandomTrees random;
  for (int i = 0; i < 3000 && !HasFatalFailure(); ++i) {
    const ConfigNode tree = random.tree(4);
    expectSame(tree, parseYaml(toYaml(tree), "t"), toYaml(tree));
  }
}

TEST(ConfigNode, OverridesReachIntoMapsAndLists) {
  ConfigNode node = parseYaml("a: {b: 1}\nl: [{x: 1}, {x: 2}]", "t");
  applyOverride(node, "a.b=5");
  applyOverride(node, "a.new.deep=text");
  applyOverride(node, "l.1.x=[1, 2]");
  EXPECT_EQ(node.find("a")->find("b")->text(), "5");
  EXPECT_EQ(node.find("a")->find("new")->find("deep")->text(), "text");
  EXPECT_EQ(node.find("l")->items()[1].find("x")->items().size(), 2u);
}

TEST(ConfigNode, OverrideErrorsNameTheFlag) {
  ConfigNode node = parseYaml("a: 1\nl: [1]", "t.yaml");
  EXPECT_THAT(errorOf([&] { applyOverride(node, "a.b.c=1"); }),
              HasSubstr("--set a.b.c=1: 'a.b.c' cannot be set below t.yaml:1:4"));
  EXPECT_THAT(errorOf([&] { applyOverride(node, "l.3=1"); }),
              HasSubstr("is not an item of the list"));
  EXPECT_THAT(errorOf([&] { applyOverride(node, "seed"); }), HasSubstr("write path=value"));
  applyOverride(node, "a=fast");
  EXPECT_EQ(errorOf([&] { ConfigReader(node).number("a"); }),
            "--set a=fast: a is fast, must be a number");
}

TEST(ConfigNode, DuplicateKeysAreRefused) {
  EXPECT_EQ(errorOf([] { parseYaml("a: 1\na: 2", "t.yaml"); }),
            "t.yaml:2:1: key 'a' stands twice in this mapping; keep one");
}

TEST_F(YamlFiles, IncludeLaysTheOwnKeysOnTop) {
  write("base.yaml", "a: {x: 1, y: 2}\nb: 3\n");
  const ConfigNode node =
      loadYamlFile(write("top.yaml", "part:\n  include: base.yaml\n  a: {y: 9}\n"));
  const ConfigNode& part = *node.find("part");
  EXPECT_EQ(part.find("a")->find("x")->text(), "1");
  EXPECT_EQ(part.find("a")->find("y")->text(), "9");
  EXPECT_THAT(part.find("b")->where().source, HasSubstr("base.yaml"));
  EXPECT_THAT(part.find("a")->find("y")->where().source, HasSubstr("top.yaml"));
}

TEST_F(YamlFiles, IncludeErrorsSayWhere) {
  const std::string top = write("top.yaml", "a: 1\npart: {include: nowhere.yaml}\n");
  EXPECT_THAT(errorOf([&] { loadYamlFile(top); }),
              HasSubstr("top.yaml:2:17: cannot include 'nowhere.yaml'"));
  write("loop.yaml", "x: {include: loop.yaml}");
  EXPECT_THAT(errorOf([&] { loadYamlFile((folder_ / "loop.yaml").string()); }),
              HasSubstr("includes itself"));
  EXPECT_THAT(errorOf([&] { loadYamlFile(write("bad.yaml", "a: [1, 2\nb: 3")); }),
              HasSubstr("not valid YAML"));
  EXPECT_THAT(errorOf([&] { loadYamlFile("/nowhere/x.yaml"); }),
              HasSubstr("/nowhere/x.yaml: cannot be read"));
}

}  // namespace
}  // namespace ballbot
