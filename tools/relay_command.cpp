#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cosim/relay.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

struct RelayArguments {
  RelayOptions options;
  double reorder_delay_ms = 3, delay_ms = 0, jitter_ms = 0;
  bool json = false;
};

nlohmann::ordered_json toJson(const RelayReport::Direction& d) {
  return {{"received", d.received},
          {"lost", d.lost},
          {"duplicated", d.duplicated},
          {"held_back", d.held_back},
          {"sent", d.sent}};
}

std::chrono::microseconds fromMs(double ms) {
  return std::chrono::microseconds(static_cast<std::int64_t>(ms * 1000));
}

ExitCode runRelay(RelayArguments a) {
  a.options.disturbance.reorder_delay = fromMs(a.reorder_delay_ms);
  a.options.disturbance.delay = fromMs(a.delay_ms);
  a.options.disturbance.jitter = fromMs(a.jitter_ms);
  a.options.stop = interruptFlag();
  const RelayReport report = relay(a.options);
  const nlohmann::ordered_json json = {{"requests", toJson(report.requests)},
                                       {"replies", toJson(report.replies)}};
  if (a.json) {
    fmt::print("{}\n", jsonText(json));
  } else {
    for (const auto& [direction, counts] : json.items()) {
      fmt::print("{}: {} received, {} lost, {} duplicated, {} held back, {} sent\n", direction,
                 counts["received"].get<long>(), counts["lost"].get<long>(),
                 counts["duplicated"].get<long>(), counts["held_back"].get<long>(),
                 counts["sent"].get<long>());
    }
  }
  return ExitCode::kPassed;  // Ctrl-C is how a relay ends
}

}  // namespace

void addRelayCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "relay",
      "Stand between controller and plant and lose, double, reorder and delay their packets");
  const auto a = std::make_shared<RelayArguments>();
  DisturbanceOptions& d = a->options.disturbance;
  command->add_option("controller_url", a->options.master_url, "LCM URL of the controller's side")
      ->required();
  command->add_option("plant_url", a->options.participant_url, "LCM URL of the plant's side")
      ->required();
  command->add_option("--channel", a->options.channel, "Only this channel (default: all)");
  command->add_option("--loss", d.loss, "Share of packets lost, 0 to 1")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--duplication", d.duplication, "Share of packets doubled")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--reordering", d.reordering, "Share of packets held back")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--reorder-delay-ms", a->reorder_delay_ms, "How long they are held back")
      ->capture_default_str();
  command->add_option("--delay-ms", a->delay_ms, "Delay of every packet")->capture_default_str();
  command->add_option("--jitter-ms", a->jitter_ms, "More delay, uniform from 0 to this")
      ->capture_default_str();
  command->add_option("--seed", d.seed, "The same seed does the same to packet k")
      ->capture_default_str();
  command->add_flag("--json", a->json, "Print the counts as JSON when it ends");
  command->footer(
      "Example, three terminals (the digest of the run does not change):\n"
      "  ballbot plant configs/scenarios/balance.yaml --lcm-url 'udpm://239.255.76.67:7702?ttl=0'\n"
      "  ballbot relay 'udpm://239.255.76.67:7701?ttl=0' 'udpm://239.255.76.67:7702?ttl=0' --loss "
      "0.2\n"
      "  ballbot controller configs/scenarios/balance.yaml --lcm-url "
      "'udpm://239.255.76.67:7701?ttl=0'\n"
      "Ends with Ctrl-C.");
  command->callback([&result, a] { result = runRelay(*a); });
}

}  // namespace ballbot
