#pragma once

#include <string>

namespace ballbot {

// What figures in SVG are drawn with; coordinates in pixels, text as it is meant (it is escaped
// here).

/// Okabe and Ito's colours, told apart by most eyes and in grey.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73",
                                    "#cc79a7", "#e69f00", "#56b4e9"};

/// A coordinate, two decimals.
std::string svgNumber(double v);
/// What a value is called beside an axis.
std::string tickText(double v);
std::string lineElement(double x1, double y1, double x2, double y2, const std::string& style);
/// @param anchor  "start", "middle" or "end": which part of the text is at x
std::string textElement(double x, double y, const std::string& anchor, const std::string& text,
                        const std::string& more = "");

/// The opening tag of a figure with its styles, white ground and title (which may be empty).
std::string figureBeginning(const std::string& title, double width, double height,
                            double title_left);

}  // namespace ballbot
