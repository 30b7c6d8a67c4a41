#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// One closed curve around the middle of a polar figure.
struct SvgPolarCurve {
  std::string name;
  int colour = 0;  ///< 0 to 5
  bool dashed = false;
  bool dotted = false;  ///< a dot at every value
  std::vector<double> angle_deg;
  std::vector<double> radius;               ///< a value that is not finite breaks the curve
  std::vector<double> low = {}, high = {};  ///< of each value, drawn as a bar; may be empty
};

/// One pair of polar axes: angles from x (to the right) towards y (up), radii from zero.
struct SvgPolar {
  std::string title;           ///< above it; may be empty
  std::string unit;            ///< of the radii
  std::string x_name, y_name;  ///< what the directions 0 and 90 degrees are called
  std::vector<SvgPolarCurve> curves = {};
};

/// A figure that stands alone, as svgFigure() draws them: axes under each other, legends beside
/// them. The same values give the same bytes.
/// @param title  may be empty
std::string svgPolarFigure(const std::string& title, const std::vector<SvgPolar>& axes);

}  // namespace ballbot
