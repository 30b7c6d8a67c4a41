#include "studies/case_result.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "report/json_text.hpp"

namespace ballbot {
namespace {

constexpr const char* kOutcomes[] = {"passed", "missed", "fell", "error", "crashed", "timed_out"};

}  // namespace

const char* toText(CaseOutcome outcome) { return kOutcomes[static_cast<int>(outcome)]; }

std::string CaseResult::toJson() const {
  nlohmann::ordered_json j;
  j["case"] = id;
  j["outcome"] = toText(outcome);
  j["reason"] = reason;
  j["simulated_s"] = simulated_s;
  j["metrics"] = metrics;
  j["trajectory_digest"] = trajectory_digest;
  j["cpu_s"] = cpu_s;
  return jsonText(j, -1);
}

CaseResult CaseResult::fromJson(const std::string& text) {
  try {
    const auto j = nlohmann::json::parse(text);
    CaseResult r;
    r.id = j.at("case");
    const std::string outcome = j.at("outcome");
    int index = 0;
    while (index < 6 && outcome != kOutcomes[index]) ++index;
    if (index == 6) throw InputError("no outcome is called '" + outcome + "'");
    r.outcome = static_cast<CaseOutcome>(index);
    r.reason = j.at("reason");
    r.simulated_s = j.at("simulated_s");
    r.metrics = j.at("metrics").get<std::map<std::string, double>>();
    r.trajectory_digest = j.at("trajectory_digest");
    r.cpu_s = j.at("cpu_s");
    return r;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(std::string("not the record of a case: ") + e.what());
  }
}

}  // namespace ballbot
