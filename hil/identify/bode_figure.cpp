#include "hil/identify/bode_figure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr int kCurvePoints = 160;
constexpr double kLeft = 60, kWidth = 560, kHeight = 190, kTop = 30, kGap = 40;

/// One of the two diagrams: frequency to the right, a value upwards.
struct Diagram {
  double top, low, high;  ///< of the picture, of the values
  double low_Hz, high_Hz;
  double x(double f) const {
    return kLeft + kWidth * std::log(f / low_Hz) / std::log(high_Hz / low_Hz);
  }
  double y(double v) const {
    return top + kHeight * (high - std::clamp(v, low, high)) / (high - low);
  }
};

double decibels(std::complex<double> z) { return 20 * std::log10(std::max(std::abs(z), 1e-6)); }
/// Unwrapped downwards from zero, since lags only grow.
double degreesBelow(std::complex<double> z, double last) {
  double d = kDegPerRad * std::arg(z);
  while (d > last + 180) d -= 360;
  return d;
}

using Curve = std::function<std::complex<double>(double)>;

std::string polyline(const Diagram& gain, const Diagram& phase, const Curve& curve,
                     const char* colour) {
  std::string up, down;
  double last = 0;
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double f =
        gain.low_Hz * std::pow(gain.high_Hz / gain.low_Hz, static_cast<double>(i) / kCurvePoints);
    const std::complex<double> z = curve(f);
    last = degreesBelow(z, last);
    up += fmt::format("{:.1f},{:.1f} ", gain.x(f), gain.y(decibels(z)));
    down += fmt::format("{:.1f},{:.1f} ", phase.x(f), phase.y(last));
  }
  const char* line = "<polyline points='{}' fill='none' stroke='{}' stroke-width='1.5'/>\n";
  return fmt::format(fmt::runtime(line), up, colour) +
         fmt::format(fmt::runtime(line), down, colour);
}

std::string grid(const Diagram& d, double step, const char* unit) {
  std::string out;
  for (double v = d.low; v <= d.high + 1e-9; v += step) {
    out += fmt::format(
        "<path d='M{0} {1:.1f}h{2}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' "
        "text-anchor='end'>{5:.0f} {6}</text>\n",
        kLeft, d.y(v), kWidth, kLeft - 5, d.y(v) + 4, v, unit);
  }
  for (const double f : {1, 2, 5, 10, 20, 50, 100, 200, 500}) {
    if (f < d.low_Hz || f > d.high_Hz) continue;
    out += fmt::format(
        "<path d='M{0:.1f} {1}v{2}' stroke='#ddd'/><text x='{0:.1f}' y='{3}' "
        "text-anchor='middle'>{4:.0f}</text>\n",
        d.x(f), d.top, kHeight, d.top + kHeight + 14, f);
  }
  return out;
}

}  // namespace

std::string bodeSvg(const std::string& drive, const Identification& found, double period) {
  const double low = found.points.front().frequency_Hz, high = found.points.back().frequency_Hz;
  const Diagram gain{kTop, -30, 10, low, high};
  const Diagram phase{kTop + kHeight + kGap, -360, 0, low, high};
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 640 500' font-family='sans-serif' "
      "font-size='11'>\n<rect width='640' height='500' fill='white'/>\n"
      "<text x='{}' y='18' font-size='12'>Torque response of {} over Hz: measured (dots), second "
      "order "
      "(blue), first (orange)</text>\n",
      kLeft, drive);
  out += grid(gain, 10, "dB") + grid(phase, 90, "deg");
  const auto draw = [&](const TorqueResponse& fit, const char* colour) {
    out += polyline(
        gain, phase, [&](double hz) { return fit.sampledAt(hz, period); }, colour);
  };
  draw(found.first, "#e69f00");
  draw(found.second, "#0072b2");
  double last = 0;
  for (const ResponsePoint& p : found.points) {
    last = degreesBelow(p.value, last);
    const char* dot = "<circle cx='{:.1f}' cy='{:.1f}' r='2.5'/>\n";
    out += fmt::format(fmt::runtime(dot), gain.x(p.frequency_Hz), gain.y(decibels(p.value)));
    out += fmt::format(fmt::runtime(dot), phase.x(p.frequency_Hz), phase.y(last));
  }
  return out + "</svg>\n";
}

}  // namespace ballbot
