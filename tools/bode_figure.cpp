#include "tools/bode_figure.hpp"

#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "report/svg_figure.hpp"

namespace ballbot {
namespace {

constexpr double kLowestGain = 1e-3;  ///< below, a loop gain says nothing
constexpr double kFar = 3;            ///< beyond, nobody asks for the distance to instability

using Sample = LoopAnalysis::Sample;

SvgSeries curve(const std::string& name, int colour, bool dashed, const LoopAnalysis& a,
                const std::function<double(const Sample&)>& value) {
  SvgSeries out{name, colour, dashed, {}, {}};
  for (const Sample& s : a.samples) {
    out.x.push_back(inHertz(s.omega));
    out.y.push_back(value(s));
  }
  return out;
}

/// Phase without jumps of a whole turn.
SvgSeries phase(const std::string& name, int colour, bool dashed, const LoopAnalysis& a,
                const std::function<std::complex<double>(const Sample&)>& response) {
  SvgSeries out =
      curve(name, colour, dashed, a, [&](const Sample& s) { return phaseDegrees(response(s)); });
  for (std::size_t i = 1; i < out.y.size(); ++i)
    out.y[i] -= 360 * std::round((out.y[i] - out.y[i - 1]) / 360);
  return out;
}

}  // namespace

std::string bodeFigure(const std::string& scenario_name, const LoopAnalysis& a) {
  const std::string frequency = "frequency [Hz]";
  SvgAxes weight{frequency, "gain, weight", true, true, {}, {}, {}, {}, {}};
  weight.series = {
      curve("shaping filter |r|", 0, false, a, [](const Sample& s) { return std::abs(s.shaping); }),
      curve("effective weight R |r|\xC2\xB2", 1, false, a,
            [](const Sample& s) { return s.weight; })};

  SvgAxes gain{frequency, "drive [dB]", true, false, {}, {}, {{"-3 dB", -3.01}}, {}, {}};
  SvgAxes angle{frequency, "drive [deg]", true, false, {}, {}, {}, {}, {}};
  const auto addDrive = [&](const std::string& name, int colour, bool dashed, auto response) {
    gain.series.push_back(
        curve(name, colour, dashed, a, [=](const Sample& s) { return inDecibel(response(s)); }));
    angle.series.push_back(phase(name, colour, dashed, a, response));
  };
  addDrive("wheel, output blocked", 0, false, [](const Sample& s) { return s.wheel_blocked; });
  addDrive("wheel, on its load", 1, false, [](const Sample& s) { return s.wheel_loaded; });
  addDrive("arm, output blocked", 2, true, [](const Sample& s) { return s.arm_blocked; });

  const auto shown = [](double g) { return g < kLowestGain ? std::nan("") : g; };
  SvgAxes loop{frequency, "loop gain", true, true, {}, {}, {{"1", 1}}, {}, {}};
  loop.series = {
      curve("ideal drives", 0, true, a, [=](const Sample& s) { return shown(s.loop_gain_ideal); }),
      curve("series elastic drives", 1, false, a,
            [=](const Sample& s) { return shown(s.loop_gain); })};
  loop.at_x = {{fmt::format("crossover {:.2f} Hz", inHertz(a.with_drives.crossover)),
                inHertz(a.with_drives.crossover)}};

  const auto near = [](double d) { return d > kFar ? std::nan("") : d; };
  SvgAxes distance{frequency, "smallest |1 + L|", true, false, {}, {}, {}, {}, {}};
  distance.series = {
      curve("ideal drives", 0, true, a, [=](const Sample& s) { return near(s.distance_ideal); }),
      curve("series elastic drives", 1, false, a,
            [=](const Sample& s) { return near(s.distance); })};
  distance.at_y = {{fmt::format("smallest {:.2f}{}", a.with_drives.distance,
                                a.margins.stable ? "" : ", UNSTABLE"),
                    a.with_drives.distance}};
  return svgFigure(
      fmt::format("{}: from the cost's weight to the loop in continuous time, delay {:.2f} ms",
                  scenario_name, 1e3 * a.delay),
      {weight, gain, angle, loop, distance});
}

}  // namespace ballbot
