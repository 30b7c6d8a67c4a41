// Both machines of the step protocol, joined by a network that loses, doubles, reorders, delays and
// damages messages at random, over many seeds.
#include <map>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "cosim/step_client.hpp"
#include "cosim/step_server.hpp"
#include "tests/cosim/support/spring_participant.hpp"

namespace ballbot {
namespace {

using testing_support::SpringParticipant;
using Reply = ballbot_msgs::step_reply;

constexpr SimDuration kStepLength{1'000'000};

/// One direction. Time is counted in rounds; message k meets the fate that (seed, k) decides.
class BadLine {
 public:
  BadLine(std::uint64_t seed, const char* direction) : random_(seed, direction) {}

  void send(const Bytes& message, std::int64_t now) {
    const std::array<double, 4> fate = random_.uniforms(count_);
    const std::array<double, 4> extra = random_.uniforms(count_++, 1);
    if (fate[0] < 0.2) return;
    const int copies = fate[1] < 0.2 ? 2 : 1;
    for (int copy = 0; copy < copies; ++copy) {
      Bytes arriving = message;
      if (extra[0] < 0.05) {
        arriving[static_cast<std::size_t>(extra[1] * static_cast<double>(arriving.size()))] ^= 8;
      }
      // Some are under way for so long that whole sessions end meanwhile.
      const double delay = fate[2] < 0.3 ? 20 * extra[2] : (fate[2] < 0.35 ? 400 * extra[2] : 0);
      under_way_.emplace(now + static_cast<std::int64_t>(delay) + 3 * copy, arriving);
    }
  }

  template <typename Handler>
  void deliver(std::int64_t now, Handler&& handler) {
    while (!under_way_.empty() && under_way_.begin()->first <= now) {
      const Bytes message = under_way_.begin()->second;
      under_way_.erase(under_way_.begin());
      handler(message);
    }
  }

 private:
  RandomStream random_;
  std::uint64_t count_ = 0;
  std::multimap<std::int64_t, Bytes> under_way_;
};

class BadNetwork {
 public:
  BadNetwork(StepServer& server, std::uint64_t seed)
      : server_(server), requests_(seed, "requests"), replies_(seed, "replies") {}

  /// Sends the pending request again and again until its reply is there.
  const Reply& exchange(StepClient& client) {
    for (int tries = 0; tries < 1000; ++tries) {
      requests_.send(client.pending(), now_);
      for (int round = 0; round < 4; ++round) {
        if (tick(&client)) return client.reply();
      }
    }
    ADD_FAILURE() << "no reply after 1000 tries";
    return client.reply();
  }

  bool tick(StepClient* client) {
    ++now_;
    requests_.deliver(now_, [&](const Bytes& message) {
      if (const Bytes* reply = server_.receive(message.data(), message.size())) {
        replies_.send(*reply, now_);
      }
    });
    bool done = false;
    replies_.deliver(now_, [&](const Bytes& message) {
      if (client == nullptr) return;
      const auto got = client->receive(message.data(), message.size());
      EXPECT_TRUE(got == StepClient::Received::kReply || got == StepClient::Received::kIgnored);
      done = done || got == StepClient::Received::kReply;
    });
    return done;
  }

 private:
  StepServer& server_;
  BadLine requests_, replies_;
  std::int64_t now_ = 0;
};

ActuatorCommand commandOf(int step) {
  ActuatorCommand command;
  command.torque.setConstant(0.01 * (step % 17));
  return command;
}

/// Digest and sensor value after every step when nothing stands in between.
std::vector<std::int64_t> undisturbed(int steps) {
  SpringParticipant spring;
  spring.enterInitializationMode(kSimStart);
  spring.exitInitializationMode();
  std::vector<std::int64_t> digests;
  for (int i = 0; i < steps; ++i) {
    spring.doStep(kSimStart + i * kStepLength, kStepLength, commandOf(i));
    digests.push_back(static_cast<std::int64_t>(spring.stateDigest()));
  }
  return digests;
}

TEST(StepProtocol, EachStepIsDoneExactlyOnceWhateverTheNetworkDoes) {
  constexpr int kSteps = 60;
  const std::vector<std::int64_t> expected = undisturbed(kSteps);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    SpringParticipant spring;
    StepServer server(spring, 1, 2);
    BadNetwork network(server, seed);

    // Two runs in sequence over one network, so that the first one's late messages meet the second.
    for (const std::int64_t session : {1001, 1002}) {
      StepClient client(session, 1);
      client.hello(kSimStart);
      ASSERT_EQ(network.exchange(client).status, Reply::OK);
      for (int i = 0; i < kSteps; ++i) {
        client.step(kSimStart + i * kStepLength, kStepLength, commandOf(i));
        const Reply& reply = network.exchange(client);
        ASSERT_EQ(reply.status, Reply::OK) << reply.text;
        ASSERT_EQ(reply.time_ns, (i + 1) * kStepLength.count());
        ASSERT_EQ(reply.state_digest, expected[static_cast<std::size_t>(i)]);
        ASSERT_EQ(spring.stepsDone(), i + 1);
      }
      client.bye();
      ASSERT_EQ(network.exchange(client).status, Reply::OK);
    }
    for (int i = 0; i < 500; ++i) network.tick(nullptr);
    EXPECT_EQ(spring.stepsDone(), kSteps);
    EXPECT_EQ(server.served(), 2 * (kSteps + 2));
  }
}

TEST(StepProtocol, AStateSurvivesTheSameNetwork) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    SpringParticipant spring;
    spring.carry(3000);
    StepServer server(spring, 1, 2);
    BadNetwork network(server, seed);
    StepClient client(5, 1);
    client.hello(kSimStart);
    network.exchange(client);
    client.step(kSimStart, kStepLength, commandOf(1));
    const std::int64_t digest = network.exchange(client).state_digest;

    StateBlob blob;
    do {
      client.save(blob.size());
      const Reply& part = network.exchange(client);
      ASSERT_EQ(part.status, Reply::OK) << part.text;
      blob.insert(blob.end(), part.chunk.begin(), part.chunk.end());
    } while (static_cast<int>(blob.size()) < client.reply().blob_size);

    client.step(kSimStart + kStepLength, kStepLength, commandOf(2));
    network.exchange(client);
    for (std::size_t sent = 0; sent < blob.size(); sent += kChunkBytes) {
      client.restore(blob, sent);
      ASSERT_EQ(network.exchange(client).status, Reply::OK);
    }
    EXPECT_EQ(client.reply().state_digest, digest);
    EXPECT_EQ(client.reply().time_ns, kStepLength.count());
  }
}

}  // namespace
}  // namespace ballbot
