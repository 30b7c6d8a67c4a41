#include "tools/realtime_doctor.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include "hil/machine/machine_facts.hpp"
#include "hil/machine/realtime_rows.hpp"
#include "hil/machine/worth.hpp"
#include "report/json_text.hpp"
#include "tools/histogram_report.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

std::vector<int> usableCores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  ::sched_getaffinity(0, sizeof set, &set);
  std::vector<int> cores;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(i, &set)) cores.push_back(i);
  }
  return cores;
}

int loopCore(int wanted) {
  const std::vector<int> usable = usableCores();
  if (wanted >= 0) {
    if (contains(usable, wanted)) return wanted;
    throw InputError(fmt::format("doctor: core {} cannot be used here; --core is one of {}", wanted,
                                 cpuListText(usable)));
  }
  for (const int core : readMachine("", 0).isolated) {
    if (contains(usable, core)) return core;
  }
  return usable.empty() ? 0 : usable.back();
}

ProcessRights rightsHere() {
  ProcessRights rights;
  rights.root = ::geteuid() == 0;
  rlimit limit{};
  ::getrlimit(RLIMIT_RTPRIO, &limit);
  rights.priority = static_cast<std::int64_t>(std::min<rlim_t>(limit.rlim_cur, 99));
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  rights.locked_bytes =
      limit.rlim_cur == RLIM_INFINITY ? -1 : static_cast<std::int64_t>(limit.rlim_cur);
  return rights;
}

nlohmann::ordered_json rowsJson(const std::vector<RealtimeRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const RealtimeRow& r : rows) {
    list.push_back({{"name", r.name},
                    {"good", r.good},
                    {"found", r.found},
                    {"wanted", r.wanted},
                    {"mend", r.mend},
                    {"worth", r.worth},
                    {"measured", r.measured}});
  }
  return list;
}

void printRows(const std::vector<RealtimeRow>& rows) {
  for (const RealtimeRow& r : rows) {
    fmt::print("{:<15} {:<8} {}\n", r.words, r.good ? "ok" : "LATE", r.found);
    if (!r.good) fmt::print("{:<24} wanted: {}\n{:<24} to mend it: {}\n", "", r.wanted, "", r.mend);
    fmt::print("{:<24} worth: {}\n", "", r.worth);
  }
}

}  // namespace

ExitCode realtimeDoctor(const RealtimeDoctorOptions& options) {
  const int core = loopCore(options.core);
  std::vector<RealtimeRow> rows = realtimeRows(readMachine("", core), rightsHere(), core);
  fmt::print(stderr, "doctor: measures on core {} for {:.3g} s\n", core, 4 * options.seconds);
  const FloorMeasurements m = measureFloors(core, options.seconds, interruptFlag());
  addWorth(rows, m, core);
  const bool good =
      std::all_of(rows.begin(), rows.end(), [](const RealtimeRow& r) { return r.good; });
  nlohmann::ordered_json j;
  j["ready"] = good;
  j["core"] = core;
  j["checks"] = rowsJson(rows);
  j["floor"] = {{"fifo", histogramJson(m.fifo)},
                {"ordinary", histogramJson(m.ordinary)},
                {"held_awake", histogramJson(m.awake)},
                {"unpinned", histogramJson(m.unpinned)}};
  if (options.json) {
    fmt::print("{}\n", jsonText(j));
  } else {
    printRows(rows);
    fmt::print("\n{}", percentilesHead(fmt::format("kernel's floor on core {}, every 1 ms", core)));
    fmt::print("{}", percentilesRow(m.grant.text, j["floor"]["fifo"]));
    fmt::print("{}", percentilesRow("the same, core held awake", j["floor"]["held_awake"]));
    fmt::print("{}", percentilesRow("the same, on any core", j["floor"]["unpinned"]));
    fmt::print("{}", percentilesRow("an ordinary thread", j["floor"]["ordinary"]));
  }
  return good ? ExitCode::kPassed : ExitCode::kRequirementMissed;
}

}  // namespace ballbot
