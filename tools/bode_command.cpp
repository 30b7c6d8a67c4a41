#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/angle.hpp"
#include "experiment/loop_analysis.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "tools/bode_figure.hpp"
#include "tools/commands.hpp"

namespace ballbot {
namespace {

/// Frequencies of the printed table [Hz].
constexpr double kTableHz[] = {0.1, 0.5, 1, 2, 5, 10, 20, 40, 60, 100, 200};

struct BodeArguments {
  std::string scenario, csv, out;
  std::vector<std::string> overrides;
  double at_s = 0;
  std::optional<double> delay_ms;
  bool json = false;
};

nlohmann::ordered_json shapeJson(const LoopShape& shape) {
  return {{"crossover_rad_per_s", shape.crossover},
          {"crossover_Hz", inHertz(shape.crossover)},
          {"smallest_distance_to_instability", shape.distance},
          {"smallest_distance_at_Hz", inHertz(shape.distance_at)}};
}

/// What has no limit is left out.
nlohmann::ordered_json marginsJson(const LoopAnalysis& a) {
  const SampledMargins& m = a.margins;
  nlohmann::ordered_json j;
  j["stable"] = m.stable;
  j["growth_rate_per_s"] = m.growth_rate;
  j["repeats_after_ms"] = 1e3 * toSeconds(a.period);
  if (!m.stable) return j;
  if (std::isfinite(m.delay_margin)) j["delay_margin_ms"] = 1e3 * m.delay_margin;
  if (std::isfinite(m.wheel_delay_margin)) j["wheel_delay_margin_ms"] = 1e3 * m.wheel_delay_margin;
  j["wheel_gain_margin_low"] = m.wheel_gain_low;
  if (std::isfinite(m.wheel_gain_high)) j["wheel_gain_margin_high"] = m.wheel_gain_high;
  return j;
}

nlohmann::ordered_json toJson(const Scenario& scenario, const LoopAnalysis& a) {
  nlohmann::ordered_json j;
  j["scenario"] = scenario.name;
  j["shaping"] = {{"zero_rad_per_s", a.shaping.zero},
                  {"pole_rad_per_s", a.shaping.pole},
                  {"weight_at_zero", a.torque_weight[0]},
                  {"weight_at_infinity", a.torque_weight[0] * a.shaping.rho() * a.shaping.rho()}};
  for (const int joint : {0, 3}) {
    const char* group = joint < kWheelCount ? "wheel" : "arm";
    const ActuatorResponse response(a.drives.actuators.of(joint), a.drives.drive_period);
    j["actuators"][group] = {
        {"wanted_bandwidth_Hz", a.drives.actuators.of(joint).torque_bandwidth},
        {"blocked_bandwidth_Hz", inHertz(response.bandwidth())},
        {"load_inertia_kgm2", a.inertia[joint]},
        {"loaded_gain_at_1_Hz", std::abs(response.loaded(kTwoPi, a.inertia[joint]))}};
  }
  j["margins"] = marginsJson(a);
  j["continuous_loop_at_the_wheels"] = {{"delay_ms", 1e3 * a.delay},
                                        {"ideal_drives", shapeJson(a.with_ideal_drives)},
                                        {"series_elastic_drives", shapeJson(a.with_drives)}};
  return j;
}

std::string csvText(const LoopAnalysis& a) {
  std::string out =
      "frequency_Hz,shaping_gain,shaping_phase_deg,wheel_weight,wheel_blocked_dB,wheel_blocked_deg,"
      "wheel_loaded_dB,wheel_loaded_deg,arm_blocked_dB,arm_blocked_deg,loop_gain_ideal,loop_gain,"
      "distance_ideal,distance\n";
  for (const LoopAnalysis::Sample& s : a.samples) {
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", inHertz(s.omega),
                       std::abs(s.shaping), phaseDegrees(s.shaping), s.weight,
                       inDecibel(s.wheel_blocked), phaseDegrees(s.wheel_blocked),
                       inDecibel(s.wheel_loaded), phaseDegrees(s.wheel_loaded),
                       inDecibel(s.arm_blocked), phaseDegrees(s.arm_blocked), s.loop_gain_ideal,
                       s.loop_gain, s.distance_ideal, s.distance);
  }
  return out;
}

std::string milliseconds(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.1f}", 1e3 * seconds) : "none";
}

std::string shapeRow(const char* name, const LoopShape& shape) {
  return fmt::format("  {:<29} {:>10.1f} {:>10.2f} {:>14.2f}\n", name, shape.crossover,
                     inHertz(shape.crossover), shape.distance);
}

std::string marginsText(const LoopAnalysis& a) {
  const SampledMargins& m = a.margins;
  std::string out = fmt::format(
      "  the loop that runs, sampled; all of it comes again after {:g} ms\n"
      "    stable: {}, {} at {:.3g} per second\n",
      1e3 * toSeconds(a.period), m.stable ? "yes" : "NO",
      m.stable ? "what dies last dies" : "a disturbance grows", std::abs(m.growth_rate));
  if (!m.stable) return out;
  const std::string most =
      std::isfinite(m.wheel_gain_high)
          ? fmt::format("{:.2g} to {:.3g}", m.wheel_gain_low, m.wheel_gain_high)
          : fmt::format("from {:.2g}", m.wheel_gain_low);
  return out + fmt::format(
                   "    delay margin, ms: {} of all six torques, {} of the wheels' alone\n"
                   "    gain margins at the wheels: {}\n",
                   milliseconds(m.delay_margin), milliseconds(m.wheel_delay_margin), most);
}

std::string tableText(const Scenario& scenario, const LoopAnalysis& a) {
  const double R = a.torque_weight[0];
  std::string out = fmt::format(
      "{}: wheel torques weighted {:g} up to {:.0f} rad/s, {:g} beyond {:.0f} rad/s\n\n",
      scenario.name, R, a.shaping.zero, R * a.shaping.rho() * a.shaping.rho(), a.shaping.pole);
  out +=
      fmt::format("  {:>9} {:>9} {:>9} {:>16} {:>16} {:>10} {:>10} {:>8}\n", "frequency", "shaping",
                  "weight", "drive, blocked", "drive, loaded", "loop gain", "with drives", "|1+L|");
  out += fmt::format("  {:>9} {:>9} {:>9} {:>16} {:>16} {:>10} {:>10} {:>8}\n", "Hz", "|r|",
                     "R |r|^2", "dB, deg", "dB, deg", "ideal", "", "");
  std::size_t next = 0;
  for (const double f : kTableHz) {
    while (next + 1 < a.samples.size() && inHertz(a.samples[next].omega) < f * (1 - 1e-9)) ++next;
    const LoopAnalysis::Sample& s = a.samples[next];
    out += fmt::format(
        "  {:>9.3g} {:>9.3f} {:>9.3g} {:>8.1f} {:>7.0f} {:>8.1f} {:>7.0f} {:>10.3g} {:>10.3g} "
        "{:>8.2f}\n",
        inHertz(s.omega), std::abs(s.shaping), s.weight, inDecibel(s.wheel_blocked),
        phaseDegrees(s.wheel_blocked), inDecibel(s.wheel_loaded), phaseDegrees(s.wheel_loaded),
        s.loop_gain_ideal, s.loop_gain, s.distance);
  }
  const ActuatorResponse wheel(a.drives.actuators.wheel, a.drives.drive_period);
  out += fmt::format(
      "\n  drive bandwidth at a wheel, blocked: {:.1f} Hz (wanted {:g}); load {:.3f} kg m^2\n",
      inHertz(wheel.bandwidth()), a.drives.actuators.wheel.torque_bandwidth, a.inertia[0]);
  out += fmt::format("\n{}\n", marginsText(a));
  out += fmt::format("  {:<29} {:>10} {:>10} {:>14}\n", "continuous loop at the wheels",
                     "crossover", "", "smallest |1+L|");
  out += fmt::format("  {:<29} {:>10} {:>10} {:>14}\n",
                     fmt::format("with a delay of {:.2f} ms", 1e3 * a.delay), "rad/s", "Hz", "");
  out += shapeRow("ideal drives", a.with_ideal_drives);
  out += shapeRow("series elastic drives", a.with_drives);
  return out;
}

ExitCode bode(const BodeArguments& arguments) {
  const RunConfig config = readRunConfig(loadScenario(arguments.scenario, arguments.overrides));
  const Scenario& scenario = config.scenario;
  std::optional<SimDuration> delay;
  if (arguments.delay_ms) delay = durationFromSeconds(1e-3 * *arguments.delay_ms);
  const LoopAnalysis analysis =
      analyseLoop(config, kSimStart + durationFromSeconds(arguments.at_s), delay);
  if (!arguments.csv.empty()) writeTextFile(arguments.csv, csvText(analysis));
  if (!arguments.out.empty()) writeTextFile(arguments.out, bodeFigure(scenario.name, analysis));
  if (arguments.json) {
    fmt::print("{}\n", jsonText(toJson(scenario, analysis)));
  } else {
    fmt::print("{}", tableText(scenario, analysis));
  }
  return ExitCode::kPassed;
}

}  // namespace

void addBodeCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand("bode",
                                             "Show how much delay and gain the balancing loop of a "
                                             "scenario can take, and in the frequency "
                                             "domain its shaping filter, actuators and crossover");
  const auto a = std::make_shared<BodeArguments>();
  command->add_option("scenario", a->scenario, "Scenario file")->required();
  command
      ->add_option("--set", a->overrides,
                   "path=value: change one value of the scenario; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--at-s", a->at_s, "Time at which the tasks' weights are read [s]")
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
  command
      ->add_option(
          "--delay-ms", a->delay_ms,
          "Delay of the continuous loop, which the curves show, instead of the scenario's [ms]")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--csv", a->csv, "File for all curves as CSV");
  command->add_option("--out", a->out, "File for the picture (SVG)");
  command->add_flag("--json", a->json, "Print the numbers as JSON");
  command->footer(
      "Examples:\n"
      "  ballbot bode configs/scenarios/balance.yaml --out bode.svg\n"
      "  ballbot bode configs/scenarios/push.yaml --set "
      "controller.mpc.wheel_shaping={actuator_bandwidth_Hz: 10}\n"
      "Margins are those of the loop that runs: sampled, with its rates, latency, plans and "
      "drives.\n"
      "Curves and crossover are those of a loop in continuous time with the law of an infinite "
      "horizon.\n"
      "docs/theory/loop.md says how both are made.\n"
      "Exit codes: 0 written, 2 bad input, 4 output could not be written.");
  command->callback([&result, a] { result = bode(*a); });
}

}  // namespace ballbot
