#include "hil/record/record_json.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

Json checkJson(const RecordedCheck& c, const FaultRecord& record) {
  const Check& check = checkOf(c.finding.fault);
  return {{"name", check.name},
          {"words", check.words},
          {"text", record.bench.textOf(c.finding)},
          {"drive", c.finding.drive},
          {"subject", subjectOf(c.finding, record.config())},
          {"value", c.finding.value},
          {"limit", c.finding.limit},
          {"cycle", c.cycle},
          {"time_s", 1e-9 * static_cast<double>(c.time_ns)},
          {"last_cycle", c.last_cycle},
          {"cycles", c.cycles},
          {"reaction",
           check.reaction == FirstReaction::kDamp ? "damping, then torque off" : "torque off"},
          {"page", std::string("docs/troubleshooting/") + check.page}};
}

template <typename Ring>
Json spanJson(const Ring& ring) {
  if (ring.empty()) return {{"count", 0}};
  return {{"count", ring.size()},
          {"overwritten", ring.pushed() - ring.size()},
          {"from_s", 1e-9 * static_cast<double>(ring[0].time_ns)},
          {"to_s", 1e-9 * static_cast<double>(ring[ring.size() - 1].time_ns)}};
}

}  // namespace

std::string subjectOf(const Finding& finding, const BenchConfig& config) {
  if (finding.drive == BenchMaster::kImuLink) return "IMU";
  if (finding.drive < 0 || finding.drive >= kDriveCount) return "";
  return config.drives[static_cast<std::size_t>(finding.drive)].name;
}

Json recordJson(const FaultRecord& record) {
  const RunFacts& facts = record.facts;
  Json out;
  out["format"] = kFormat;
  out["first_check"] =
      record.hasFault() ? checkJson(record.recorder.first(), record) : Json(nullptr);
  out["checks"] = Json::array();
  for (const RecordedCheck& c : record.recorder.checks()) {
    out["checks"].push_back(checkJson(c, record));
  }
  out["ending"] = facts.ending;
  out["exit_code"] = facts.exit_code;
  out["torque_off"] = record.bench.torqueIsOff();
  out["last_word"] = record.bench.lastWord();
  out["zero_s"] = 1e-9 * static_cast<double>(record.zeroNs());
  out["zero_cycle"] = record.zeroCycle();
  out["epoch_offset_s"] = 1e-9 * static_cast<double>(facts.epoch_offset_ns);
  out["bench_file"] = facts.bench_file;
  out["overrides"] = facts.overrides;
  out["runner"] = facts.runner;
  out["cycle_s"] = record.config().cycleSeconds();
  out["bench_digest"] = facts.bench_digest;
  out["config_digest"] = facts.config_digest;
  out["version"] = facts.version;
  out["revision"] = facts.revision;
  out["cycles"] = spanJson(record.recorder.cycles());
  out["frames"] = spanJson(record.recorder.frames());
  return out;
}

}  // namespace ballbot
