#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "hil/record/fault_record.hpp"
#include "hil/rehearsal/rehearsal.hpp"

namespace ballbot {

/// A run on emulated drives with joints in motion, a fault that is done to it, and its record.
class RehearsedRecord {
 public:
  /// @param fault  done after 100 cycles; null: a good run
  explicit RehearsedRecord(RunnerKind kind, const std::function<void(Rehearsal&)>& fault = nullptr)
      : rehearsal_(Rehearsal::defaultConfig(), kind) {
    constexpr int kBefore = 100, kAfter = 150;
    engaged_ = rehearsal_.engage();
    for (int i = 0; i < kBefore + kAfter && !rehearsal_.ended(); ++i) {
      if (i == kBefore && fault) fault(rehearsal_);
      BenchCommand command;
      for (std::size_t n = 0; n < kDriveCount; ++n) {
        command.torque[n] = 0.5 * (1 + std::sin(0.1257 * i + 0.5 * static_cast<double>(n)));
      }
      rehearsal_.cycle(&command);
    }
    rehearsal_.finish();
  }

  bool engaged() const { return engaged_; }
  Rehearsal& rehearsal() { return rehearsal_; }
  FaultRecord record() const {
    RunFacts facts;
    facts.bench_file = "rehearsal";
    facts.runner = toText(rehearsal_.kind());
    facts.ending = rehearsal_.why();
    facts.exit_code = static_cast<int>(rehearsal_.exitCode());
    return {rehearsal_.bench(), rehearsal_.recorder(), facts};
  }

 private:
  Rehearsal rehearsal_;
  bool engaged_ = false;
};

}  // namespace ballbot
