#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "survey/robot_survey.hpp"

namespace ballbot {

/// What `ballbot robot` found, for people.
std::string surveyText(const RobotParameters& robot, const RobotSurvey& survey);
/// And for programs; what has no limit is left out.
nlohmann::ordered_json surveyJson(const RobotParameters& robot, const RobotSurvey& survey);

}  // namespace ballbot
