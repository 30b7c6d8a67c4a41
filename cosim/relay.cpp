#include "cosim/relay.hpp"

#include <map>
#include <vector>

#include <fmt/format.h>
#include <poll.h>

#include "core/error.hpp"
#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_transport.hpp"
#include "cosim/lcm_url.hpp"

namespace ballbot {
namespace {

using std::chrono::microseconds;

// So often the stop flag is looked at when nothing happens.
constexpr std::chrono::milliseconds kStopInterval{100};
constexpr int kTakenAtOnce = 64;
// A lockstep has few messages under way at once; what a stranger sends beyond this is lost.
constexpr std::size_t kMostHeld = 4096;

/// One direction: takes messages from one network and gives them to the other when they are due.
class Lane {
 public:
  Lane(LcmBus& from, LcmBus& to, const RelayOptions& options, const char* direction,
       const char* suffix)
      : from_(from), to_(to), disturbance_(options.disturbance, direction) {
    options.channel.empty() ? from_.subscribeToEnding(suffix)
                            : from_.subscribe(options.channel + suffix);
  }

  // What has come by now, up to a limit: a flood must not keep the other direction waiting.
  void takeWaiting() {
    const LcmBus::Message* message = nullptr;
    for (int i = 0; i < kTakenAtOnce && from_.receive(message, WallDuration{}); ++i) {
      disturbance_.decide(static_cast<std::uint64_t>(counts_.received++), copies_);
      if (copies_.empty()) ++counts_.lost;
      if (copies_.size() > 1) ++counts_.duplicated;
      if (waiting_.size() + copies_.size() > kMostHeld) {
        ++counts_.lost;
        continue;
      }
      for (const microseconds after : copies_) {
        if (after > microseconds{0}) ++counts_.held_back;
        waiting_.emplace(WallClock::now() + after, *message);
      }
    }
  }

  // Returns when the next one is due.
  WallClock::time_point deliver(WallClock::time_point now) {
    while (!waiting_.empty() && waiting_.begin()->first <= now) {
      const LcmBus::Message& message = waiting_.begin()->second;
      if (to_.publish(message.channel, message.data.data(), message.data.size())) {
        ++counts_.sent;
      }
      waiting_.erase(waiting_.begin());
    }
    return waiting_.empty() ? WallClock::time_point::max() : waiting_.begin()->first;
  }

  int fileDescriptor() const { return from_.fileDescriptor(); }
  const RelayReport::Direction& counts() const { return counts_; }

 private:
  LcmBus& from_;
  LcmBus& to_;
  Disturbance disturbance_;
  std::multimap<WallClock::time_point, LcmBus::Message> waiting_;
  std::vector<microseconds> copies_;
  RelayReport::Direction counts_;
};

}  // namespace

RelayReport relay(const RelayOptions& options) {
  options.disturbance.check();
  if (!options.channel.empty()) requireChannelName(options.channel);
  const std::string network = LcmUrl::parse(options.master_url).network();
  if (network == LcmUrl::parse(options.participant_url).network()) {
    throw InputError(fmt::format(
        "both sides of the relay are the LCM network {}; give one another port", network));
  }
  LcmBus master(options.master_url);
  LcmBus participant(options.participant_url);
  // Each side is listened to for one kind only, so nothing the relay sends comes back to it.
  Lane requests(master, participant, options, "requests", kRequestSuffix);
  Lane replies(participant, master, options, "replies", kReplySuffix);
  if (options.listening != nullptr) options.listening->store(true);

  while (options.stop == nullptr || !options.stop->load()) {
    const WallClock::time_point now = WallClock::now();
    const auto due = std::min(requests.deliver(now), replies.deliver(now));
    const auto wait = std::min<WallDuration>(kStopInterval, due - now);
    const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(wait).count();
    pollfd sides[] = {{requests.fileDescriptor(), POLLIN, 0},
                      {replies.fileDescriptor(), POLLIN, 0}};
    const timespec limit{0, ns};
    if (::ppoll(sides, 2, &limit, nullptr) <= 0) continue;
    requests.takeWaiting();
    replies.takeWaiting();
  }
  return {requests.counts(), replies.counts()};
}

}  // namespace ballbot
