#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cosim/lcm_transport.hpp"
#include "cosim/serve.hpp"
#include "experiment/run_experiment.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

struct PlantArguments {
  std::string scenario;
  std::string lcm_url = sharedLcmAddress().url, channel = sharedLcmAddress().channel;
  std::vector<std::string> overrides;
  bool keep_serving = false, quiet = false;
};

}  // namespace

void addPlantCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "plant", "Serve a scenario's plant over LCM, for a controller in another terminal or host");
  const auto a = std::make_shared<PlantArguments>();
  command->add_option("scenario", a->scenario, "Scenario file; the controller must use the same")
      ->required();
  command->add_option("--lcm-url", a->lcm_url, "LCM URL; ttl=0 keeps packets on this machine")
      ->capture_default_str();
  command->add_option("--channel", a->channel, "LCM channel")->capture_default_str();
  command
      ->add_option("--set", a->overrides,
                   "path=value, as for run; must be the same as the controller's")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_flag("--keep-serving", a->keep_serving, "Serve run after run until Ctrl-C");
  command->add_flag("--quiet", a->quiet, "Say only errors");
  command->footer(
      "Example, two terminals:\n"
      "  ballbot plant configs/scenarios/balance.yaml\n"
      "  ballbot controller configs/scenarios/balance.yaml\n"
      "LCM authenticates nobody: whoever reaches the URL can drive the plant.\n"
      "Exit codes: 0 the run ended, 2 bad input, 3 the controller was lost, 130 interrupted.");
  command->callback([&result, a] {
    ServeOptions options;
    options.keep_serving = a->keep_serving;
    options.stop = interruptFlag();
    if (!a->quiet)
      options.say = [](const std::string& words) { fmt::print(stderr, "{}\n", words); };
    servePlant(loadScenario(a->scenario, a->overrides), {a->lcm_url, a->channel}, options);
    result = interruptFlag()->load() ? ExitCode::kInterrupted : ExitCode::kPassed;
  });
}

}  // namespace ballbot
