#include "cosim/log_compare.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "cosim/log_reader.hpp"

namespace ballbot {
namespace {

/// Whether this message says what recorders write: hashes of at least one event, in order.
bool isSound(const ballbot_msgs::tick_digests& d) {
  const auto ticks = static_cast<std::size_t>(std::max(d.tick_count, 0));
  return ticks > 0 && d.offset_ns.size() == ticks && d.hash.size() == ticks * kChannelCount &&
         d.offset_ns.front() == 0 && std::is_sorted(d.offset_ns.begin(), d.offset_ns.end());
}

/// The hashes of one run, event by event, of a log that is whole as far as it goes.
class TickHashes {
 public:
  explicit TickHashes(const std::string& path) {
    RunLog log = readRunLog(path);
    if (!log.damage.none()) throw InputError(fmt::format("{}: {}", path, log.damage.text()));
    digests_ = std::move(log.digests);
    if (digests_.empty()) {
      throw InputError(
          fmt::format("{}: holds no {} messages, so it cannot be compared tick by tick", path,
                      kTickDigestsChannel));
    }
    for (std::size_t i = 0; i < digests_.size(); ++i) requireSound(path, i);
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
  void requireSound(const std::string& path, std::size_t i) const {
    const ballbot_msgs::tick_digests& d = digests_[i];
    if (!isSound(d)) {
      throw InputError(
          fmt::format("{}: {} message {} has {} hashes and {} times for {} ticks of {} channels; "
                      "another version of this program wrote it, or another program",
                      path, kTickDigestsChannel, i, d.hash.size(), d.offset_ns.size(), d.tick_count,
                      kChannelCount));
    }
    if (i == 0 || d.first_tick == digests_[i - 1].first_tick + digests_[i - 1].tick_count) return;
    throw InputError(fmt::format("{}: {} message {} begins with tick {}, must with tick {}", path,
                                 kTickDigestsChannel, i, d.first_tick,
                                 digests_[i - 1].first_tick + digests_[i - 1].tick_count));
  }

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
