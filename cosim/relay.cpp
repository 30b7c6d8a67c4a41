#include "cosim/relay.hpp"

#include <map>
#include <vector>

#include <fmt/format.h>
#include <poll.h>

#include "core/error.hpp"
#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_transport.hpp"

namespace ballbot {
namespace {

using std::chrono::microseconds;

// So often the stop flag is looked at when nothing happens.
constexpr std::chrono::milliseconds kStopInterval{100};

/// One direction: takes messages from one network and gives them to the other when they are due.
class Lane {
 public:
  Lane(LcmBus& from, LcmBus& to, const RelayOptions& options, const char* direction,
       const char* suffix)
      : from_(from), to_(to), disturbance_(options.disturbance, direction) {
    from_.subscribe((options.channel.empty() ? std::string{".*"} : options.channel) + suffix);
  }

  void takeAll() {
    const LcmBus::Message* message = nullptr;
    while (from_.receive(message, WallDuration{})) {
      disturbance_.decide(static_cast<std::uint64_t>(counts_.received++), copies_);
      if (copies_.empty()) ++counts_.lost;
      if (copies_.size() > 1) ++counts_.duplicated;
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
      if (to_.publish(message.channel.c_str(), message.data.data(), message.data.size())) {
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
  if (udpmNetwork(options.master_url) == udpmNetwork(options.participant_url)) {
    throw InputError(
        fmt::format("both sides of the relay are the LCM network {}; give one another "
                    "port",
                    udpmNetwork(options.master_url)));
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
    requests.takeAll();
    replies.takeAll();
  }
  return {requests.counts(), replies.counts()};
}

}  // namespace ballbot
