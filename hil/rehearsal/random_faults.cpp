#include <algorithm>

#include "core/random.hpp"
#include "hil/rehearsal/fault_table.hpp"
#include "hil/rehearsal/trial.hpp"

namespace ballbot {
namespace {

constexpr int kLatestStart = 20;  // cycles after the first fault

/// Numbers of one combination, drawn one after the other.
class Draw {
 public:
  Draw(const RandomStream& stream, int index) : stream_(stream), index_(index) {}
  int below(int bound) {
    const auto four = stream_.uniforms(static_cast<std::uint64_t>(index_), block_++);
    return std::min(bound - 1, static_cast<int>(four[0] * bound));
  }

 private:
  const RandomStream& stream_;
  int index_;
  std::uint64_t block_ = 0;
};

/// Both in this runner, and in one run: not those that need a bench of their own.
bool combines(const FaultCase& fault, RunnerKind kind) {
  return !fault.while_ready && !fault.without_master &&
         (kind == RunnerKind::kStepped ? fault.stepped : fault.real_time);
}

bool holds(const std::vector<Trial::Timed>& faults, const FaultRow& row) {
  if (row.exit_code == 0 || (row.says_off && row.torque_on)) return false;
  // A drive that obeys nothing ends by its own watch over the master, whenever that is.
  const bool may_stay = std::any_of(faults.begin(), faults.end(), [](const Trial::Timed& t) {
    return t.fault->reaction == Reaction::kSaid;
  });
  if (may_stay && row.exit_code == static_cast<int>(ExitCode::kTorqueNotOff)) return true;
  return row.measured_cycles >= 0 && row.measured_cycles <= row.bound_cycles;
}

}  // namespace

std::vector<FaultRow> rehearseRandomFaults(int count, std::uint64_t seed) {
  const std::vector<FaultCase> all = allCases();
  const RandomStream stream(seed, "hil.random_faults");
  std::vector<FaultRow> rows;
  for (int i = 0; i < count; ++i) {
    Draw draw(stream, i);
    const RunnerKind kind = draw.below(2) == 0 ? RunnerKind::kStepped : RunnerKind::kRealTime;
    const int number = 2 + draw.below(2);
    std::vector<Trial::Timed> faults;
    std::string name;
    while (static_cast<int>(faults.size()) < number) {
      const FaultCase& fault =
          all[static_cast<std::size_t>(draw.below(static_cast<int>(all.size())))];
      const bool twice = std::any_of(faults.begin(), faults.end(),
                                     [&](const Trial::Timed& t) { return t.fault == &fault; });
      if (twice || !combines(fault, kind)) continue;
      faults.push_back({&fault, faults.empty() ? 0 : draw.below(kLatestStart + 1)});
      name +=
          (name.empty() ? "" : " + ") + fault.name +
          (faults.back().at_cycle > 0 ? " (" + std::to_string(faults.back().at_cycle) + ")" : "");
    }
    Trial trial(faults, kind);
    FaultRow row = trial.run();
    row.fault = name;
    row.expected = "off in time, or said";
    row.held = holds(faults, row);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace ballbot
