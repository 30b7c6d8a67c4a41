#include "hil/doubt/parameter_watch.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace ballbot {
namespace {

bool holds(const SetupStep& step, std::int64_t value) noexcept {
  switch (step.kind) {
    case SetupStep::Kind::kExpectBits:
      return (value & step.value) == step.value;
    case SetupStep::Kind::kAtLeast:
      return value >= step.value;
    default:
      return value == step.value;
  }
}

/// Two's complement of as many bits as the expected value was written with.
std::int64_t asWritten(const SetupStep& step, std::uint64_t value) noexcept {
  if (step.value >= 0 || step.size == 0 || step.size >= 8) return static_cast<std::int64_t>(value);
  const std::uint64_t sign = std::uint64_t{1} << (8U * step.size - 1U);
  return static_cast<std::int64_t>((value ^ sign) - sign);
}

}  // namespace

// Drive by drive within an object: the same object of all drives is seen soon after another.
ParameterWatch::ParameterWatch(const std::vector<std::vector<SetupStep>>& setups) {
  std::size_t longest = 0;
  for (const auto& setup : setups) longest = std::max(longest, setup.size());
  for (std::size_t n = 0; n < longest; ++n) {
    for (std::size_t drive = 0; drive < setups.size(); ++drive) {
      if (n >= setups[drive].size() || !setups[drive][n].watched) continue;
      entries_.push_back({static_cast<int>(drive), setups[drive][n]});
    }
  }
  at_ = entries_.empty() ? 0 : entries_.size() - 1;
}

ParameterWatch::Question ParameterWatch::next() noexcept {
  if (entries_.empty()) return {};
  at_ = (at_ + 1) % entries_.size();
  return {entries_[at_].drive, entries_[at_].step.check};
}

Finding ParameterWatch::onAnswer(bool given, std::uint64_t value) noexcept {
  if (!given) {
    ++unanswered_;
    return {};
  }
  ++answered_;
  const Entry& entry = entries_[at_];
  const std::int64_t is = asWritten(entry.step, value);
  if (holds(entry.step, is)) return {};
  wrong_ = at_;
  found_ = is;
  return {BenchFault::kParameterChanged, entry.drive, static_cast<double>(is),
          static_cast<double>(entry.step.value)};
}

std::string ParameterWatch::text() const {
  if (entries_.empty()) return "";
  const SetupStep& step = entries_[wrong_].step;
  return fmt::format("{} {} is {}, was set to {}", toText(step.check), step.what, found_,
                     step.value);
}

}  // namespace ballbot
