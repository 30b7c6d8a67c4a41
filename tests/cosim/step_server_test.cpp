#include "cosim/step_server.hpp"

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "cosim/step_client.hpp"
#include "tests/cosim/support/spring_participant.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::SpringParticipant;
using Header = ballbot_msgs::step_header;
using Reply = ballbot_msgs::step_reply;
using Session = StepServer::Session;

constexpr std::uint64_t kConfig = 0xC0FFEE;
constexpr SimDuration kStepLength{1'000'000};

class StepServerTest : public testing::Test {
 protected:
  /// The server's reply, decoded; status -1 if it says nothing.
  Reply ask(const Bytes& request) {
    Reply reply{};
    reply.status = -1;
    const Bytes* bytes = server.receive(request.data(), request.size());
    if (bytes != nullptr) {
      EXPECT_TRUE(decodeMessage(bytes->data(), bytes->size(), reply));
    }
    return reply;
  }
  Reply stepOf(StepClient& master) {
    const Reply reply = ask(master.step(simTimeFromNs(now_ns), kStepLength, {}));
    if (reply.status == Reply::OK) now_ns = reply.time_ns;
    return reply;
  }
  /// A copy of `request` with something changed and the checksum made good.
  Bytes changed(const Bytes& request,
                const std::function<void(ballbot_msgs::step_request&)>& change) {
    ballbot_msgs::step_request message{};
    EXPECT_TRUE(decodeMessage(request.data(), request.size(), message));
    change(message);
    Bytes out;
    encodeMessage(message, out);
    return out;
  }

  static constexpr std::int8_t kSilence = -1;
  SpringParticipant spring;
  StepServer server{spring, kConfig, 99};
  StepClient client{1111, kConfig};
  std::int64_t now_ns = 0;
};

TEST_F(StepServerTest, HelloInitialisesAndAnswersWithTheFirstMeasurement) {
  const Reply reply = ask(client.hello(simTimeFromNs(5'000)));
  EXPECT_EQ(reply.status, Reply::OK);
  EXPECT_EQ(reply.time_ns, 5'000);
  EXPECT_EQ(reply.sensors.joint_angle[1], 0.2);
  EXPECT_EQ(reply.truth_count, 1);
  EXPECT_EQ(reply.server, 99);
  EXPECT_EQ(static_cast<std::uint64_t>(reply.state_digest), spring.stateDigest());
  EXPECT_EQ(server.session(), Session::kOpen);
}

TEST_F(StepServerTest, RealDrivesSendNoTruth) {
  SpringParticipant drives(1, false);
  StepServer hil(drives, kConfig, 1);
  const Bytes& hello = client.hello(kSimStart);
  const Bytes* bytes = hil.receive(hello.data(), hello.size());
  ASSERT_NE(bytes, nullptr);
  Reply reply{};
  ASSERT_TRUE(decodeMessage(bytes->data(), bytes->size(), reply));
  EXPECT_EQ(reply.truth_count, 0);
}

TEST_F(StepServerTest, ARepeatedRequestGetsTheSameReplyAndIsNotActedOn) {
  ask(client.hello(kSimStart));
  stepOf(client);
  const Bytes first = *server.receive(client.pending().data(), client.pending().size());
  for (int i = 0; i < 5; ++i) {
    const Bytes* again = server.receive(client.pending().data(), client.pending().size());
    ASSERT_NE(again, nullptr);
    EXPECT_EQ(*again, first);
  }
  EXPECT_EQ(spring.stepsDone(), 1);
  EXPECT_EQ(server.resent(), 6);
}

TEST_F(StepServerTest, MakesNoStepThatNobodyCouldInterrupt) {
  ask(client.hello(kSimStart));
  const Reply reply = ask(client.step(kSimStart, SimDuration{20'000'000'000}, {}));
  EXPECT_EQ(reply.status, Reply::MISUSED);
  EXPECT_EQ(reply.text, "a step of 20 s, at most 1 s is made at once");
  EXPECT_EQ(spring.stepsDone(), 0);
}

TEST_F(StepServerTest, KnowsNoTimeBeforeTheStartOrNearTheEndOfTime) {
  EXPECT_THAT(ask(client.hello(simTimeFromNs(-1))).text, HasSubstr("hello at"));
  StepServer fresh(spring, kConfig, 99);
  const Bytes late = StepClient(7, kConfig).hello(SimTime::max());
  Reply reply{};
  const Bytes* bytes = fresh.receive(late.data(), late.size());
  ASSERT_TRUE(bytes != nullptr && decodeMessage(bytes->data(), bytes->size(), reply));
  EXPECT_EQ(reply.status, Reply::MISUSED);
}

TEST_F(StepServerTest, AnOlderRequestIsIgnoredAndCounted) {
  const Bytes hello = client.hello(kSimStart);
  ask(hello);
  stepOf(client);
  EXPECT_EQ(ask(hello).status, kSilence);
  EXPECT_EQ(server.ignored().old, 1);
  EXPECT_EQ(server.time(), kSimStart + kStepLength);
}

TEST_F(StepServerTest, ARequestThatLeavesANumberOutIsAnError) {
  ask(client.hello(kSimStart));
  client.step(kSimStart, kStepLength, {});  // never sent
  const Reply reply = stepOf(client);
  EXPECT_EQ(reply.status, Reply::MISUSED);
  EXPECT_EQ(reply.text, "spring: request 3 came after 1, one was left out");
  EXPECT_EQ(spring.stepsDone(), 0);
}

TEST_F(StepServerTest, RequestsOfAForeignSessionAreIgnoredAndCounted) {
  ask(client.hello(kSimStart));
  StepClient stranger(2222, kConfig);
  stranger.hello(kSimStart);
  EXPECT_EQ(stepOf(stranger).status, kSilence);
  EXPECT_EQ(server.ignored().foreign, 1);
  EXPECT_EQ(spring.stepsDone(), 0);
}

TEST_F(StepServerTest, ASecondRunIsToldThatTheParticipantIsInUse) {
  ask(client.hello(kSimStart));
  stepOf(client);
  StepClient second(2222, kConfig);
  const Reply reply = ask(second.hello(kSimStart));
  EXPECT_EQ(reply.status, Reply::REFUSED);
  EXPECT_THAT(reply.text, HasSubstr("spring is in use by another run, now at 0.001000 s"));
  EXPECT_EQ(stepOf(client).status, Reply::OK);
}

TEST_F(StepServerTest, ADelayedHelloOfARetiredSessionNeverResetsARun) {
  const Bytes old_hello = client.hello(kSimStart);
  ask(old_hello);
  stepOf(client);
  ask(client.bye());
  EXPECT_EQ(ask(old_hello).status, kSilence);

  StepClient second(2222, kConfig);
  now_ns = 0;
  ask(second.hello(kSimStart));
  stepOf(second);
  EXPECT_EQ(ask(old_hello).status, kSilence);
  EXPECT_EQ(server.time(), kSimStart + kStepLength);
  EXPECT_EQ(stepOf(second).status, Reply::OK);
  ask(second.bye());
  EXPECT_EQ(ask(old_hello).status, kSilence);
  EXPECT_EQ(server.session(), Session::kClosed);
}

TEST_F(StepServerTest, AnotherConfigurationIsRefusedInWords) {
  StepClient other(2222, 0xBEEF);
  const Reply reply = ask(other.hello(kSimStart));
  EXPECT_EQ(reply.status, Reply::REFUSED);
  EXPECT_EQ(reply.text,
            "spring runs configuration 0000000000c0ffee, its master 000000000000beef. Start both "
            "with the same scenario and the same --set options.");
  EXPECT_EQ(server.session(), Session::kNone);
}

TEST_F(StepServerTest, OtherMessageDefinitionsAreRefusedInWords) {
  const Bytes hello =
      changed(client.hello(kSimStart), [](auto& request) { request.message_digest ^= 1; });
  EXPECT_THAT(ask(hello).text, HasSubstr("were built with different message definitions"));
}

TEST_F(StepServerTest, AnotherProtocolVersionIsRefusedInWords) {
  const Bytes hello =
      changed(client.hello(kSimStart), [](auto& request) { request.header.protocol_version = 7; });
  const Reply reply = ask(hello);
  EXPECT_EQ(reply.status, Reply::REFUSED);
  EXPECT_THAT(reply.text, HasSubstr("spring speaks version 1 of the step protocol"));
  EXPECT_THAT(reply.text, HasSubstr("it says 7"));
}

TEST_F(StepServerTest, AHelloWhoseLayoutIsUnknownIsRefusedInWords) {
  Bytes hello = client.hello(kSimStart);
  hello[0] = static_cast<std::uint8_t>(hello[0] ^ 0xFF);
  hello.resize(hello.size() - 40);
  sealMessage(hello);
  const Reply reply = ask(hello);
  EXPECT_EQ(reply.status, Reply::REFUSED);
  EXPECT_EQ(reply.header.session, 1111);
  EXPECT_EQ(reply.header.sequence, 1);
}

TEST_F(StepServerTest, DamagedBytesAreIgnoredAndCounted) {
  Bytes hello = client.hello(kSimStart);
  hello[40] ^= 4;
  EXPECT_EQ(ask(hello).status, kSilence);
  EXPECT_EQ(ask({}).status, kSilence);
  EXPECT_EQ(ask(Bytes(1400, 0xAA)).status, kSilence);
  EXPECT_EQ(server.ignored().damaged, 3);
}

TEST_F(StepServerTest, AFailureOfTheParticipantIsAReplyInWordsAndComesOnceMoreWhenAsked) {
  ask(client.hello(kSimStart));
  spring.failAt(kSimStart + kStepLength);
  const Reply reply = stepOf(client);
  EXPECT_EQ(reply.status, Reply::FAILED);
  EXPECT_EQ(reply.exit_code, static_cast<int>(ExitCode::kBadInput));
  EXPECT_EQ(reply.text, "spring: broke at 0.001000 s");
  EXPECT_EQ(ask(client.pending()).text, reply.text);
}

TEST_F(StepServerTest, ACommandThatIsNotFiniteIsRefused) {
  ask(client.hello(kSimStart));
  ActuatorCommand command;
  command.stiffness[0] = std::numeric_limits<double>::quiet_NaN();
  const Reply reply = ask(client.step(kSimStart, kStepLength, command));
  EXPECT_EQ(reply.status, Reply::FAILED);
  EXPECT_THAT(reply.text, HasSubstr("stiffness_wheel1 is nan"));
}

TEST_F(StepServerTest, AStepFromAnotherTimeFails) {
  ask(client.hello(kSimStart));
  const Reply reply = ask(client.step(simTimeFromNs(77), kStepLength, {}));
  EXPECT_EQ(reply.status, Reply::FAILED);
  EXPECT_THAT(reply.text, HasSubstr("but it stands at"));
}

TEST_F(StepServerTest, ResetStartsAgainAtTheGivenTime) {
  const Reply first = ask(client.hello(kSimStart));
  for (int i = 0; i < 3; ++i) stepOf(client);
  const Reply again = ask(client.reset(kSimStart));
  EXPECT_EQ(again.status, Reply::OK);
  EXPECT_EQ(again.time_ns, 0);
  EXPECT_EQ(again.state_digest, first.state_digest);
}

TEST_F(StepServerTest, ByeIsAnsweredAsOftenAsItIsAskedUntilTheMasterKnows) {
  ask(client.hello(kSimStart));
  EXPECT_EQ(ask(client.bye()).status, Reply::OK);
  EXPECT_EQ(server.session(), Session::kClosed);
  EXPECT_EQ(ask(client.pending()).status, Reply::OK);
  EXPECT_EQ(server.session(), Session::kClosed);
  EXPECT_EQ(ask(client.farewell()).status, kSilence);
  EXPECT_EQ(server.session(), Session::kReleased);
  // A bye that was long under way changes nothing any more.
  EXPECT_EQ(stepOf(client).status, kSilence);
  EXPECT_EQ(server.session(), Session::kReleased);
}

TEST_F(StepServerTest, AbortEndsTheSessionEvenWhenRequestsWereLost) {
  ask(client.hello(kSimStart));
  client.step(kSimStart, kStepLength, {});  // lost
  EXPECT_EQ(ask(client.abort()).status, Reply::OK);
  EXPECT_EQ(server.session(), Session::kAborted);
}

TEST_F(StepServerTest, AProbeIsAnsweredAtAnyTimeAndChangesNothing) {
  ask(client.hello(kSimStart));
  StepClient other(4444, kConfig);
  const Bytes probe =
      changed(other.hello(kSimStart), [](auto& request) { request.header.kind = Header::PROBE; });
  const Reply reply = ask(probe);
  EXPECT_EQ(reply.header.session, 4444);
  EXPECT_EQ(reply.text, "spring");
  EXPECT_EQ(stepOf(client).status, Reply::OK);
}

TEST_F(StepServerTest, AStateOfManyMessagesIsSavedAndRestored) {
  ask(client.hello(kSimStart));
  spring.carry(5000);
  for (int i = 0; i < 4; ++i) stepOf(client);
  StateBlob blob;
  Reply part;
  do {
    part = ask(client.save(blob.size()));
    ASSERT_EQ(part.status, Reply::OK);
    ASSERT_LE(part.chunk.size(), kChunkBytes);
    blob.insert(blob.end(), part.chunk.begin(), part.chunk.end());
  } while (static_cast<int>(blob.size()) < part.blob_size);
  EXPECT_GT(blob.size(), 5000U);
  const std::uint64_t digest = spring.stateDigest();

  SpringParticipant fresh;
  StepServer other(fresh, kConfig, 100);
  StepClient master(3333, kConfig);
  const auto tell = [&](const Bytes& request) {
    Reply reply{};
    const Bytes* bytes = other.receive(request.data(), request.size());
    EXPECT_TRUE(bytes != nullptr && decodeMessage(bytes->data(), bytes->size(), reply));
    return reply;
  };
  tell(master.hello(kSimStart));
  Reply last;
  for (std::size_t sent = 0; sent < blob.size(); sent += kChunkBytes) {
    last = tell(master.restore(blob, sent));
    ASSERT_EQ(last.status, Reply::OK) << last.text;
  }
  EXPECT_EQ(fresh.stateDigest(), digest);
  EXPECT_EQ(last.time_ns, 4'000'000);
  EXPECT_EQ(last.sensors.sim_time_ns, 4'000'000);
}

TEST_F(StepServerTest, PartsOfAStateThatDoNotFollowAreAnError) {
  ask(client.hello(kSimStart));
  const StateBlob blob(2000, 1);
  ask(client.restore(blob, 0));
  const Reply reply = ask(client.restore(blob, 2 * kChunkBytes));
  EXPECT_EQ(reply.status, Reply::MISUSED);
  EXPECT_THAT(reply.text, HasSubstr("do not continue the 700 that came"));
}

TEST_F(StepServerTest, ADamagedStateIsRefusedInWords) {
  ask(client.hello(kSimStart));
  const Reply reply = ask(client.restore(StateBlob(100, 7), 0));
  EXPECT_EQ(reply.status, Reply::FAILED);
  EXPECT_EQ(reply.exit_code, static_cast<int>(ExitCode::kBadInput));
  EXPECT_THAT(reply.text, HasSubstr("are not a saved participant state"));
}

TEST_F(StepServerTest, AfterWithdrawingEveryRequestFailsWithTheReason) {
  ask(client.hello(kSimStart));
  server.withdraw("spring was stopped by a signal");
  const Reply reply = stepOf(client);
  EXPECT_EQ(reply.status, Reply::FAILED);
  EXPECT_EQ(reply.text, "spring was stopped by a signal");
  EXPECT_EQ(spring.stepsDone(), 0);
}

TEST_F(StepServerTest, ADroppedSessionIsOverAndAnotherMayBegin) {
  ask(client.hello(kSimStart));
  stepOf(client);
  server.drop();
  EXPECT_EQ(stepOf(client).status, kSilence);
  StepClient second(2222, kConfig);
  const Reply reply = ask(second.hello(kSimStart));
  EXPECT_EQ(reply.status, Reply::OK);
  EXPECT_EQ(reply.time_ns, 0);
}

}  // namespace
}  // namespace ballbot
