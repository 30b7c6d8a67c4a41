// Whole UDP packets as a stranger on the LCM address may send them, taken by all that receives:
// the packet reader, both ends of the step protocol, and the socket itself.
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_transport.hpp"
#include "cosim/remote_participant.hpp"
#include "cosim/step_client.hpp"
#include "cosim/step_server.hpp"
#include "model/signal_check.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/stranger.hpp"
#include "tests/fuzz/mutator.hpp"

namespace ballbot {
namespace {

using testing_support::Mutator;
using testing_support::SpringParticipant;
using testing_support::Stranger;
using Received = StepClient::Received;

constexpr SimDuration kStepLength{1'000'000};
constexpr std::size_t kLongest = 2000;  // beyond what is taken
constexpr const char* kRequestChannel = "FUZZ_REQUEST";

Bytes packetOf(const std::string& channel, const Bytes& message) {
  Bytes packet;
  EXPECT_TRUE(buildLcmPacket(channel, message.data(), message.size(), 7, packet));
  return packet;
}

/// What both ends say in a short run, one message of each kind.
struct Dialogue {
  Dialogue() {
    SpringParticipant spring;
    StepServer server(spring, 1, 9);
    StepClient client(5, 1);
    const auto exchange = [&](const Bytes& request) {
      requests.push_back(request);
      replies.push_back(*server.receive(request.data(), request.size()));
      client.receive(replies.back().data(), replies.back().size());
    };
    exchange(client.hello(kSimStart));
    exchange(client.step(kSimStart, kStepLength, {}));
    exchange(client.save(0));
    const ballbot_msgs::step_reply saved = client.reply();
    exchange(client.restore(StateBlob(saved.chunk.begin(), saved.chunk.end()), 0));
    exchange(client.reset(kSimStart));
    exchange(client.bye());
  }
  std::vector<Bytes> requests, replies;
};

/// A message with something wrong, half of the time with a checksum that says it is whole.
Bytes spoiled(const Bytes& message, Mutator& mutator) {
  Bytes out = message;
  mutator.mutate(out, kMaxMessageBytes);
  if (mutator.below(2) == 0 && out.size() >= 16) sealMessage(out);
  return out;
}

TEST(PacketFuzz, NoPacketIsReadBeyondItsEnd) {
  const Dialogue dialogue;
  Mutator mutator(1);
  int taken = 0;
  for (int round = 0; round < 1'200'000; ++round) {
    const Bytes& message = dialogue.replies[mutator.below(dialogue.replies.size())];
    Bytes packet = packetOf(kRequestChannel, message);
    mutator.mutate(packet, kLongest);
    const Bytes exact(packet.begin(), packet.end());  // no spare room behind it
    const auto read = parseLcmPacket(exact.data(), exact.size());
    if (!read) continue;
    ++taken;
    ASSERT_TRUE(isChannelName(read->channel));
    ASSERT_LE(read->size, kMaxMessageBytes);
    ASSERT_LE(read->data + read->size, exact.data() + exact.size());
  }
  EXPECT_GT(taken, 40'000);
}

TEST(ServerFuzz, NoRequestBreaksAParticipant) {
  const Dialogue dialogue;
  Mutator mutator(2);
  std::int64_t served = 0;
  for (int round = 0; round < 12'000; ++round) {
    SpringParticipant spring;
    StepServer server(spring, 1, 9);
    for (std::size_t i = 0; i < 20; ++i) {
      // A session gets under way before it is spoiled.
      const bool whole = i < mutator.below(4);
      const Bytes& honest = dialogue.requests[whole ? i : mutator.below(dialogue.requests.size())];
      const Bytes message = whole ? honest : spoiled(honest, mutator);
      const Bytes* reply = server.receive(message.data(), message.size());
      if (reply == nullptr) continue;
      ballbot_msgs::step_reply read{};
      ASSERT_TRUE(decodeMessage(reply->data(), reply->size(), read));
    }
    served += server.served();
  }
  EXPECT_GT(served, 12'000);
}

TEST(ClientFuzz, NoReplyBreaksAMaster) {
  const Dialogue dialogue;
  Mutator mutator(3);
  int taken = 0;
  for (int round = 0; round < 240'000; ++round) {
    StepClient client(5, 1);
    client.hello(kSimStart);
    const Bytes message =
        spoiled(dialogue.replies[mutator.below(dialogue.replies.size())], mutator);
    if (client.receive(message.data(), message.size()) == Received::kReply) ++taken;
  }
  EXPECT_GT(taken, 2'000);
}

/// A far end that answers every request with a spoiled copy of an honest reply.
class LyingTransport final : public Transport {
 public:
  explicit LyingTransport(std::uint64_t seed) : mutator_(seed), server_(spring_, 1, 9) {}

  void send(const std::uint8_t* data, std::size_t size) override {
    ballbot_msgs::step_header header{};
    ending_ = decodeHeader(data, size, header) && header.kind == ballbot_msgs::step_header::ABORT;
    const Bytes* reply = server_.receive(data, size);
    waiting_ = reply != nullptr;
    if (!waiting_) return;
    next_ = *reply;
    if (mutator_.below(3) != 0) {
      // Behind the header, so that it counts as the answer.
      Bytes tail(next_.begin() + kHeaderEnd, next_.end());
      mutator_.mutate(tail, kMaxMessageBytes - kHeaderEnd);
      next_.resize(kHeaderEnd);
      next_.insert(next_.end(), tail.begin(), tail.end());
      sealMessage(next_);
    }
  }
  bool receive(Bytes& out, WallDuration) override {
    if (std::exchange(waiting_, false)) {
      out = next_;
      return true;
    }
    // Nothing more will come, however long the master waits.
    if (!ending_) throw LostParticipantError("liar", "what it said was ignored");
    return false;
  }
  std::string describe() const override { return "a liar"; }

 private:
  static constexpr std::ptrdiff_t kHeaderEnd = 8 + 8 + 4 + 8 + 8 + 1 + 8;  // and the server
  Mutator mutator_;
  SpringParticipant spring_;
  StepServer server_;
  bool waiting_ = false, ending_ = false;
  Bytes next_;
};

TEST(MasterFuzz, BelievesNothingThatCannotBe) {
  int believed = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 16'000; ++seed) {
    LyingTransport liar(seed);
    RemoteOptions options;
    options.config_digest = 1;
    options.patience = options.first_patience = std::chrono::milliseconds{0};
    RemoteParticipant remote(liar, options);
    try {
      remote.enterInitializationMode(kSimStart);
      SimTime now = kSimStart;
      for (int i = 0; i < 4; ++i) {
        remote.doStep(now, kStepLength, {});
        now += kStepLength;
        ASSERT_EQ(firstImpossible(remote.sensors(), now), "");
        ++believed;
      }
      (void)remote.saveState();
    } catch (const Error& error) {
      ASSERT_NE(std::string(error.what()), "");
      ++refused;
    }
  }
  EXPECT_GT(believed, 2'000);
  EXPECT_GT(refused, 2'000);
}

TEST(BusFuzz, StaysUsableUnderAnyTraffic) {
  const LcmAddress address = privateLcmAddress();
  LcmBus bus(address.url), friendly(address.url);
  bus.subscribe(kRequestChannel);
  Stranger stranger(address.url);
  const Dialogue dialogue;
  Mutator mutator(5);
  const LcmBus::Message* message = nullptr;
  for (int round = 0; round < 8'000; ++round) {
    for (int i = 0; i < 10; ++i) {
      Bytes packet =
          packetOf(kRequestChannel, dialogue.requests[mutator.below(dialogue.requests.size())]);
      mutator.mutate(packet, kLongest);
      if (mutator.below(8) == 0) packet.resize(60'000);
      if (mutator.below(4) == 0 && packet.size() > 3) packet[3] = '3';  // part of a long message
      stranger.send(packet);
    }
    while (bus.receive(message, WallDuration{})) {
      ASSERT_LE(message->data.size(), kMaxMessageBytes);
    }
  }
  // What waits may fill the buffer, so the first tries may be lost, as on any network.
  const Bytes honest(100, 9);
  bool heard = false;
  for (int tries = 0; tries < 50 && !heard; ++tries) {
    ASSERT_TRUE(friendly.publish(kRequestChannel, honest.data(), honest.size()));
    while (!heard && bus.receive(message, std::chrono::milliseconds{100})) {
      heard = message->data == honest;
    }
  }
  EXPECT_TRUE(heard);
}

}  // namespace
}  // namespace ballbot
