#include "cosim/log_compare.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "cosim/log_reader.hpp"

namespace ballbot {
namespace {

/// The hashes of one run, event by event.
class TickHashes {
 public:
  explicit TickHashes(const std::string& path) : digests_(readRunLog(path).digests) {
    if (digests_.empty()) {
      throw InputError(
          fmt::format("{}: holds no {} messages, so it cannot be compared tick by tick", path,
                      kTickDigestsChannel));
    }
    for (const ballbot_msgs::tick_digests& d : digests_) {
      if (d.hash_count != d.tick_count * static_cast<std::int32_t>(kChannelCount)) {
        throw InputError(
            fmt::format("{}: its {} messages have {} hashes for {} ticks of {} channels; "
                        "another version of this program wrote it",
                        path, kTickDigestsChannel, d.hash_count, d.tick_count, kChannelCount));
      }
    }
  }

  bool atEnd() const { return message_ == digests_.size(); }
  std::int64_t tick() const { return at().first_tick + row_; }
  SimTime time() const {
    return simTimeFromNs(at().first_time_ns + at().offset_ns[static_cast<std::size_t>(row_)]);
  }
  std::int32_t hash(std::size_t channel) const {
    return at().hash[static_cast<std::size_t>(row_) * kChannelCount + channel];
  }
  void advance() {
    if (++row_ < at().tick_count) return;
    row_ = 0;
    ++message_;
  }

 private:
  const ballbot_msgs::tick_digests& at() const { return digests_[message_]; }

  std::vector<ballbot_msgs::tick_digests> digests_;
  std::size_t message_ = 0;
  std::int32_t row_ = 0;
};

RunDifference differenceAt(const TickHashes& run, std::optional<Channel> channel,
                           const std::string& what) {
  return {run.tick(), run.time(), channel,
          fmt::format("tick {} at {}: {}", run.tick(), toText(run.time()), what)};
}

}  // namespace

std::optional<RunDifference> compareLogs(const std::string& path_a, const std::string& path_b,
                                         RunBegin begin) {
  TickHashes a(path_a), b(path_b);
  if (begin == RunBegin::kMayBeLater) {
    const std::int64_t first = std::max(a.tick(), b.tick());
    while (!a.atEnd() && a.tick() < first) a.advance();
    while (!b.atEnd() && b.tick() < first) b.advance();
  }
  for (; !a.atEnd() && !b.atEnd(); a.advance(), b.advance()) {
    if (a.time() != b.time() || a.tick() != b.tick()) {
      return differenceAt(
          a, std::nullopt,
          fmt::format("the other run has tick {} at {} instead", b.tick(), toText(b.time())));
    }
    for (std::size_t channel = 0; channel < kChannelCount; ++channel) {
      if (a.hash(channel) == b.hash(channel)) continue;
      const bool both = a.hash(channel) != 0 && b.hash(channel) != 0;
      return differenceAt(a, static_cast<Channel>(channel),
                          fmt::format("{} {}", kChannelNames[channel],
                                      both ? "differs" : "is there in one run only"));
    }
  }
  if (a.atEnd() && b.atEnd()) return std::nullopt;
  return differenceAt(a.atEnd() ? b : a, std::nullopt,
                      fmt::format("{} ended before", a.atEnd() ? path_a : path_b));
}

}  // namespace ballbot
