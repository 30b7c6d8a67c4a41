#include "tools/live_feed.hpp"

#include "ballbot_msgs/step_reply.hpp"
#include "cosim/step_protocol.hpp"
#include "messages/convert.hpp"
#include "model/signal_check.hpp"

namespace ballbot {
namespace {

using WallTime = std::chrono::steady_clock;
constexpr auto kFramePeriod = std::chrono::milliseconds(40);
constexpr auto kPatience = std::chrono::milliseconds(100);

}  // namespace

LiveFeed::LiveFeed(const LcmAddress& address, LiveScene scene)
    : bus_(address.url), scene_(std::move(scene)) {
  requireChannelName(address.channel);
  bus_.subscribe(address.channel + kReplySuffix);
  listener_ = std::thread([this] { listen(); });
}

LiveFeed::~LiveFeed() {
  quit_.store(true);
  listener_.join();
}

void LiveFeed::listen() {
  ballbot_msgs::step_reply reply;
  auto due = WallTime::now();
  while (!quit_.load()) {
    const LcmBus::Message* message = nullptr;
    if (!bus_.receive(message, kPatience) || WallTime::now() < due) continue;
    const Bytes& data = message->data;
    if (fingerprint(data.data(), data.size()) != ballbot_msgs::step_reply::getHash() ||
        !decodeMessage(data.data(), data.size(), reply) || reply.truth_count != 1) {
      continue;
    }
    TruthFrame truth;
    if (!fromMessage(reply.truth[0], truth)) continue;
    if (!firstImpossible(truth, kLatestTime).empty()) continue;  // nothing that can be drawn
    due = WallTime::now() + kFramePeriod;
    std::string frame = scene_.frame(truth);
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_ = std::move(frame);
    ++number_;
    changed_.notify_all();
  }
}

bool LiveFeed::next(std::uint64_t& seen, std::string& out, std::chrono::milliseconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, timeout, [&] { return number_ > seen; })) return false;
  seen = number_;
  out = newest_;
  return true;
}

}  // namespace ballbot
