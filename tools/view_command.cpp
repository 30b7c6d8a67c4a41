#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/run_folder.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "report/page_template.hpp"
#include "tools/commands.hpp"
#include "tools/http_server.hpp"
#include "tools/interrupt.hpp"
#include "tools/live_feed.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  std::string what;
  bool live = false, json = false;
  int port = 0;
  std::string lcm_url = sharedLcmAddress().url, channel = sharedLcmAddress().channel;
  std::vector<std::string> overrides;
};

/// Says where, then serves until Ctrl-C, which is how this ends when all is well.
void serveUntilInterrupted(HttpServer& server, const std::string& what, bool json) {
  const std::atomic<bool>* stop = interruptFlag();
  if (json) {
    fmt::print("{}\n",
               jsonText(nlohmann::ordered_json{{"url", server.url()}, {"shows", what}}, -1));
  } else {
    fmt::print("{}\n", server.url());
  }
  std::fflush(stdout);
  fmt::print(stderr, "Showing {}; Ctrl-C ends this.\n", what);
  server.serve(*stop);
}

void viewRun(const ViewArguments& a) {
  const fs::path folder(a.what);
  if (!fs::is_regular_file(folder / "report.html")) {
    throw InputError(fmt::format(
        "{}: no report.html in it; give a run folder such as runs/balance-001, or --live with the "
        "scenario of a run to come",
        a.what));
  }
  HttpServer server(a.port);
  const auto serveFile = [&](const std::string& path, const char* name, const char* type) {
    if (!fs::is_regular_file(folder / name)) return;
    server.onGet(path, type, [file = (folder / name).string()] { return readTextFile(file); });
  };
  serveFile("/", "report.html", "text/html; charset=utf-8");
  serveFile("/report.html", "report.html", "text/html; charset=utf-8");
  serveFile("/summary.json", "summary.json", "application/json");
  serveFile("/manifest.json", "manifest.json", "application/json");
  serveFile("/timing.json", "timing.json", "application/json");
  serveFile("/scenario.yaml", "scenario.yaml", "text/plain; charset=utf-8");
  serveUntilInterrupted(server, a.what, a.json);
}

void viewLive(const ViewArguments& a) {
  const RunConfig config = readRunConfig(loadScenario(a.what, a.overrides));
  LiveScene scene(config);
  HttpServer server(a.port);
  server.onGet("/", "text/html; charset=utf-8", [] { return livePage(); });
  server.onGet("/scene.json", "application/json", [text = scene.description()] { return text; });
  LiveFeed feed({a.lcm_url, a.channel}, std::move(scene));
  server.onEvents("/events", feed);
  serveUntilInterrupted(server, fmt::format("runs of {} on {}", config.scenario.name, a.lcm_url),
                        a.json);
}

}  // namespace

void addViewCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand(
      "view", "Show a run in the browser: a finished one, or one as it happens");
  const auto a = std::make_shared<ViewArguments>();
  command->add_option("what", a->what, "Run folder; with --live the scenario of the run")
      ->required();
  command->add_flag("--live", a->live, "Show a run as it happens, heard over LCM");
  command->add_option("--port", a->port, "Port on 127.0.0.1; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--lcm-url", a->lcm_url, "With --live: where plant and controller meet")
      ->capture_default_str();
  command->add_option("--channel", a->channel, "With --live: their LCM channel")
      ->capture_default_str();
  command->add_option("--set", a->overrides, "With --live: path=value, as for the run")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command->add_flag("--json", a->json, "Print where it serves as JSON");
  command->footer(
      "Prints the URL to open. Examples:\n"
      "  ballbot view runs/push-001\n"
      "  ballbot view --live configs/scenarios/push.yaml      and, in another terminal,\n"
      "  ballbot run --live configs/scenarios/push.yaml\n"
      "Exit codes: 0 ended by Ctrl-C, 2 bad input.");
  command->callback([&result, a] {
    a->live ? viewLive(*a) : viewRun(*a);
    result = ExitCode::kPassed;
  });
}

}  // namespace ballbot
