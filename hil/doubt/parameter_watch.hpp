#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/doubt/finding.hpp"
#include "hil/drive_setup.hpp"

namespace ballbot {

/// What was set up must stay so: goes round the objects of all drives, one question by SDO at a
/// time, and compares the answers. Pure: somebody else asks and brings the answers. Nothing
/// allocates after construction.
class ParameterWatch {
 public:
  /// @param setups  of each drive; steps that are marked `watched` are read again and again
  explicit ParameterWatch(const std::vector<std::vector<SetupStep>>& setups);

  struct Question {
    int drive = -1;
    ObjectAddress object;
  };
  /// What to ask next; calling it again goes on to the one after.
  Question next() noexcept;
  /// The answer to the question that next() gave last.
  /// @param given  false: refused, or none came: nothing is known, and counted
  Finding onAnswer(bool given, std::uint64_t value) noexcept;

  /// Questions in one round.
  int size() const noexcept { return static_cast<int>(entries_.size()); }
  std::int64_t answered() const noexcept { return answered_; }
  std::int64_t unanswered() const noexcept { return unanswered_; }
  /// The parameter of the last finding in words: "6072:00 max torque is 1500, was set to 200".
  std::string text() const;

 private:
  struct Entry {
    int drive;
    SetupStep step;
  };
  std::vector<Entry> entries_;
  std::size_t at_ = 0;
  std::int64_t answered_ = 0, unanswered_ = 0;
  std::size_t wrong_ = 0;
  std::int64_t found_ = 0;
};

}  // namespace ballbot
