#pragma once

#include <string>

namespace ballbot {

/// The page without data: style, program and two marks that reportPage() replaces. The build makes
/// it from viewer/ (see viewer/CMakeLists.txt).
const std::string& pageTemplate();

/// The page that shows a run as it happens, complete. It asks its server for scene.json and events.
const std::string& livePage();

/// Stands in the template where the title, as HTML text, belongs.
inline constexpr char kTitleMark[] = "<!--report-title-->";
/// Stands in the template where the data, as JSON inside a script element, belong.
inline constexpr char kDataMark[] = "<!--report-data-->";

}  // namespace ballbot
