#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// One line of an SVG figure. Values that are not finite break it.
struct SvgSeries {
  std::string name;
  int colour = 0;  ///< 0 to 5
  bool dashed = false;
  std::vector<double> x, y;
};

/// A straight line across the axes that names a value, e.g. a limit or a crossover.
struct SvgMark {
  std::string name;
  double value = 0;
};

/// A stretch along x that is shaded, e.g. a push.
struct SvgSpan {
  double from = 0, to = 0;
};

/// The area between two lines, e.g. a confidence band; drawn beneath the lines.
struct SvgBand {
  int colour = 0;  ///< 0 to 5
  std::vector<double> x, low, high;
};

/// One pair of axes.
struct SvgAxes {
  std::string x_label, y_label;       ///< with units, e.g. "frequency [Hz]"
  bool log_x = false, log_y = false;  ///< values that are not positive are gaps there
  std::vector<SvgSeries> series = {};
  std::vector<SvgMark> at_x = {}, at_y = {};
  std::vector<SvgSpan> shaded = {};
  std::vector<SvgBand> bands = {};
  std::vector<std::string> x_words = {};  ///< what x = 0, 1, ... are called, instead of numbers
};

/// A figure that stands alone: axes under each other, legends beside them, nothing fetched from
/// anywhere. The same values give the same bytes.
/// @param title  may be empty
std::string svgFigure(const std::string& title, const std::vector<SvgAxes>& axes);

/// Round numbers at which an axis from `low` to `high` is labelled, in ascending order: on a log
/// axis whole powers of ten (and 2 and 5 times them where it spans less than two decades).
std::vector<double> axisTicks(double low, double high, bool log);

}  // namespace ballbot
