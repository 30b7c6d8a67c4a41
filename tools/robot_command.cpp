#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/config_visitor.hpp"
#include "core/yaml_file.hpp"
#include "experiment/text_file.hpp"
#include "model/robot_reader.hpp"
#include "model/robot_urdf.hpp"
#include "report/json_text.hpp"
#include "survey/robot_draft.hpp"
#include "tools/commands.hpp"
#include "tools/robot_output.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

struct RobotArguments {
  std::string file, like = "configs/robots/ballbot.yaml", draft;
  std::vector<std::string> overrides;
  bool json = false;
};

bool isUrdf(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  return ending == ".urdf" || ending == ".xml";
}

std::string seenFrom(const fs::path& folder, const std::string& path) {
  const fs::path relative = fs::proximate(path, folder.empty() ? fs::path(".") : folder);
  return relative.string();
}

/// The links that --set names, before there is a description.
RobotLinks namedLinks(const std::vector<std::string>& overrides) {
  ConfigNode tree = parseYaml("{}", "links");
  for (const std::string& o : overrides) {
    if (o.rfind("links", 0) == 0) applyOverride(tree, o);
  }
  RobotLinks links;
  ConfigReader in(tree, "robot");
  if (!in.has("links")) return links;
  ConfigReader names = in.child("links");
  readDescribed(names, links);
  names.finish();
  return links;
}

/// The `robot:` section that is meant.
ConfigNode describedRobot(const RobotArguments& a) {
  if (!isUrdf(a.file)) return loadYamlFile(a.file);
  if (!fs::exists(a.like)) {
    throw InputError(fmt::format(
        "there is no file '{}', whose drives and sensors a URDF alone is given: name a description "
        "with --like",
        a.like));
  }
  const RobotDraft draft(a.file, namedLinks(a.overrides));
  if (!a.draft.empty()) {
    const fs::path folder = fs::path(a.draft).parent_path();
    writeTextFile(a.draft, draft.text(seenFrom(folder, a.file), seenFrom(folder, a.like)));
    fmt::print(stderr, "written: {}\n", a.draft);
  }
  return draft.laidOn(loadYamlFile(a.like));
}

ExitCode robotCommand(const RobotArguments& a) {
  if (!fs::exists(a.file)) throw InputError(fmt::format("there is no file '{}'", a.file));
  if (!a.draft.empty() && !isUrdf(a.file)) {
    throw InputError(fmt::format("--new makes a description from a URDF; '{}' is one", a.file));
  }
  if (!a.draft.empty() && fs::exists(a.draft)) {
    throw InputError(fmt::format("'{}' is there already, and nothing is overwritten", a.draft));
  }
  ConfigNode tree = describedRobot(a);
  for (const std::string& o : a.overrides) applyOverride(tree, o);
  ConfigReader in(tree, "robot");
  const RobotParameters robot = readRobot(in);
  RobotSurvey survey = surveyRobot(robot);
  const RobotUrdf urdf = readRobotUrdf(tree);
  survey.warnings.insert(survey.warnings.end(), urdf.read.notes.begin(), urdf.read.notes.end());
  if (a.json) {
    fmt::print("{}\n", jsonText(surveyJson(robot, survey)));
  } else {
    fmt::print("{}", surveyText(robot, survey));
  }
  return ExitCode::kPassed;
}

}  // namespace

void addRobotCommand(CLI::App& program, ExitCode& result) {
  auto* app = program.add_subcommand("robot", "Tell what a robot is and can do, before any run");
  auto a = std::make_shared<RobotArguments>();
  app->add_option("file", a->file, "Its description (YAML), or its URDF alone")->required();
  app->add_option("--like", a->like,
                  "With a URDF alone: description whose drives and sensors it is given")
      ->capture_default_str();
  app->add_option("--new", a->draft,
                  "Write the description that a URDF alone is given, to go on with");
  app->add_option("--set", a->overrides,
                  "path=value: change one value of the description; repeatable")
      ->allow_extra_args(false);
  app->add_flag("--json", a->json, "Print JSON");
  app->footer(
      "Examples:\n"
      "  ballbot robot configs/robots/ballbot.yaml\n"
      "  ballbot robot my_robot.urdf --new my_robot.yaml\n"
      "  ballbot robot my_robot.urdf --set links.base=chassis_link --json\n"
      "Exit codes: 0 it can stand, 2 bad input, or a robot that cannot, 4 output could not be "
      "written.");
  app->callback([a, &result] { result = robotCommand(*a); });
}

}  // namespace ballbot
