// A run over LCM while strangers send to the same address: it must give the digest of a quiet one.
#include <atomic>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include "core/random.hpp"
#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_transport.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/relay.hpp"
#include "cosim/remote_participant.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/spring_process.hpp"
#include "tests/cosim/support/spring_run.hpp"
#include "tests/cosim/support/stranger.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using testing_support::fragment;
using testing_support::SpringParticipant;
using testing_support::SpringProcess;
using testing_support::SpringRun;
using testing_support::Stranger;

std::string digestInMemory() {
  SpringParticipant spring;
  Lifecycle guarded(spring);
  return SpringRun(guarded).finish();
}

RemoteOptions remoteOptions() {
  RemoteOptions options;
  options.config_digest = 1;
  return options;
}

/// Sends, all the time and on both channels of a run, what once ended programs and what might.
class Attack {
 public:
  explicit Attack(const LcmAddress& address)
      : stranger_(address.url), channel_(address.channel), thread_([this] { run(); }) {}
  ~Attack() {
    stop_ = true;
    thread_.join();
    EXPECT_GT(sent_, 0);
  }

 private:
  void run() {
    const RandomStream random(1, "attack");
    while (!stop_) {
      for (const char* suffix : {kRequestSuffix, kReplySuffix}) {
        const std::string channel = channel_ + suffix;
        const auto drawn = random.uniforms(static_cast<std::uint64_t>(sent_));
        send(fragment(100, 0xFFFFFFF0, 1, 2, channel));
        send(fragment(static_cast<std::uint32_t>(drawn[0] * 4e9), 0, 0, 2, channel));
        send(fragment(0, 0, 0, 0, channel));
        send({'L', 'C', '0', '2'});
        send(Bytes(60'000, 'L'));
        Bytes packet;
        Bytes noise(static_cast<std::size_t>(drawn[1] * kMaxMessageBytes));
        for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(drawn[2] * 256);
        if (buildLcmPacket(channel, noise.data(), noise.size(), 0, packet)) send(packet);
        send(reply(drawn[3]));
      }
      std::this_thread::sleep_for(milliseconds{1});
    }
  }
  void send(const Bytes& packet) {
    stranger_.send(packet);
    ++sent_;
  }
  // Well formed, of a session that does not exist, with a count that lies.
  Bytes reply(double drawn) const {
    ballbot_msgs::step_reply message{};
    message.header.session = 1;
    message.header.sequence = static_cast<std::int64_t>(drawn * 100);
    Bytes encoded, packet;
    encodeMessage(message, encoded);
    const std::size_t text_length_at = 8 + 8 + 4 + 8 + 8 + 1 + 8 + 1 + 1;
    encoded[text_length_at] = 0x80;
    sealMessage(encoded);
    buildLcmPacket(channel_ + kReplySuffix, encoded.data(), encoded.size(), 0, packet);
    return packet;
  }

  Stranger stranger_;
  const std::string channel_;
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> sent_{0};
  std::thread thread_;
};

TEST(HostilePeers, ChangeNoBitOfARun) {
  const LcmAddress address = privateLcmAddress();
  SpringProcess plant(address);
  const Attack attack(address);
  LcmTransport transport(address, LinkEnd::kMaster);
  RemoteParticipant remote(transport, remoteOptions());
  EXPECT_EQ(SpringRun(remote).finish(), digestInMemory());
  EXPECT_EQ(plant.wait(), 0);
}

TEST(HostilePeers, ChangeNoBitBehindARelay) {
  const LcmAddress near = privateLcmAddress();
  const LcmAddress far{privateLcmAddress().url, near.channel};
  SpringProcess plant(far);
  std::atomic<bool> stop{false}, listening{false};
  RelayOptions options;
  options.master_url = near.url;
  options.participant_url = far.url;
  options.stop = &stop;
  options.listening = &listening;
  std::thread relaying([&] { relay(options); });
  while (!listening) std::this_thread::sleep_for(milliseconds{1});
  {
    const Attack attack(near);
    LcmTransport transport(near, LinkEnd::kMaster);
    RemoteParticipant remote(transport, remoteOptions());
    EXPECT_EQ(SpringRun(remote).finish(), digestInMemory());
  }
  stop = true;
  relaying.join();
}

TEST(LcmBus, UnderstandsLcmsOwnLibraryAndIsUnderstood) {
  const std::string url = privateLcmAddress().url;
  LcmBus bus(url);
  bus.subscribe("FROM_LIBRARY");
  lcm_t* library = lcm_create(url.c_str());
  ASSERT_NE(library, nullptr);
  Bytes heard;
  lcm_subscribe(
      library, "FROM_US",
      [](const lcm_recv_buf_t* received, const char*, void* to) {
        const auto* data = static_cast<const std::uint8_t*>(received->data);
        static_cast<Bytes*>(to)->assign(data, data + received->data_size);
      },
      &heard);

  const Bytes sent(kMaxMessageBytes, 42);
  ASSERT_EQ(lcm_publish(library, "FROM_LIBRARY", sent.data(), static_cast<unsigned>(sent.size())),
            0);
  const LcmBus::Message* message = nullptr;
  ASSERT_TRUE(bus.receive(message, milliseconds{2000}));
  EXPECT_EQ(message->channel, "FROM_LIBRARY");
  EXPECT_EQ(message->data, sent);

  ASSERT_TRUE(bus.publish("FROM_US", sent.data(), sent.size()));
  for (int i = 0; i < 20 && heard.empty(); ++i) lcm_handle_timeout(library, 100);
  EXPECT_EQ(heard, sent);
  lcm_destroy(library);
}

TEST(LcmBus, AFloodForOthersDoesNotProlongAWait) {
  const LcmAddress address = privateLcmAddress();
  const Attack attack(address);
  LcmBus bus(address.url);
  bus.subscribe("NOBODY_SENDS_HERE");
  const LcmBus::Message* message = nullptr;
  const WallClock::time_point started = WallClock::now();
  EXPECT_FALSE(bus.receive(message, milliseconds{100}));
  EXPECT_LT(WallClock::now() - started, milliseconds{2000});
  EXPECT_GE(WallClock::now() - started, milliseconds{95});
}

}  // namespace
}  // namespace ballbot
