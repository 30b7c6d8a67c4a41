#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {

/// A copy of the example robot's folder in which texts can be replaced.
class EditedRobot : public ::testing::Test {
 protected:
  void SetUp() override {
    namespace fs = std::filesystem;
    std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');  // of a parameter
    folder_ = fs::temp_directory_path() / ("ballbot_urdf_" + std::to_string(getpid()) + "_" + name);
    fs::create_directories(folder_);
    for (const auto& entry : fs::directory_iterator(fs::path(robotFile()).parent_path())) {
      fs::copy(entry.path(), folder_ / entry.path().filename(),
               fs::copy_options::overwrite_existing);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Replaces the first `from` after `anchor`.
  void edit(const std::string& file, const std::string& anchor, const std::string& from,
            const std::string& to) {
    std::stringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    std::string s = text.str();
    const std::size_t start = s.find(anchor);
    ASSERT_NE(start, std::string::npos) << anchor;
    const std::size_t at = s.find(from, start);
    ASSERT_NE(at, std::string::npos) << from;
    s.replace(at, from.size(), to);
    std::ofstream(folder_ / file) << s;
  }
  void editUrdf(const std::string& anchor, const std::string& from, const std::string& to) {
    edit("ballbot.urdf", anchor, from, to);
  }
  /// Before the end of the robot, in the last line.
  void addToUrdf(const std::string& xml) { editUrdf("", "</robot>", xml + "</robot>"); }
  void setTotalMass(const std::string& mass_kg) {
    edit("ballbot.yaml", "", "total_mass_kg: 25.0", "total_mass_kg: " + mass_kg);
  }

  RobotParameters read() const {
    const ConfigNode tree = loadYamlFile((folder_ / "ballbot.yaml").string());
    ConfigReader in(tree, "robot");
    return readRobot(in);
  }

  /// The error that reading makes, with the folder cut off.
  std::string error() const {
    return errorOf([this] { read(); });
  }
  template <typename Work>
  std::string errorOf(Work&& work) const {
    try {
      std::forward<Work>(work)();
    } catch (const InputError& e) {
      std::string text = e.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at; (at = text.find(prefix)) != std::string::npos;)
        text.erase(at, prefix.size());
      return text;
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

/// A link with an <inertial> of this mass and inertia, and the joint that it hangs on.
inline std::string partXml(const std::string& name, const std::string& parent, double mass,
                           double moment, const std::string& joint_type = "fixed",
                           const std::string& origin = "0 0 0") {
  const std::string I = std::to_string(moment);
  return "<link name=\"" + name + "\"><inertial><mass value=\"" + std::to_string(mass) +
         "\"/><inertia ixx=\"" + I + "\" iyy=\"" + I + "\" izz=\"" + I +
         "\"/></inertial></link><joint name=\"" + name + "_joint\" type=\"" + joint_type +
         "\"><parent link=\"" + parent + "\"/><child link=\"" + name + "\"/><origin xyz=\"" +
         origin + "\"/></joint>";
}

}  // namespace ballbot
