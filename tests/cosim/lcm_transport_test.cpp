// Real LCM traffic over the loopback of this machine, ttl 0.
#include "cosim/lcm_transport.hpp"

#include <atomic>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_url.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/relay.hpp"
#include "cosim/remote_participant.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/spring_process.hpp"
#include "tests/cosim/support/spring_run.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing_support::SpringParticipant;
using testing_support::SpringProcess;
using testing_support::SpringRun;
using testing_support::wordsOf;

std::string digestInMemory() {
  SpringParticipant spring;
  Lifecycle guarded(spring);
  return SpringRun(guarded).finish();
}

RemoteOptions remoteOptions() {
  RemoteOptions options;
  options.config_digest = 1;
  options.first_patience = milliseconds{5000};
  return options;
}

TEST(LcmTransport, CarriesMessagesBothWaysAndOnlyOnItsChannel) {
  const LcmAddress address = privateLcmAddress();
  LcmTransport master(address, LinkEnd::kMaster), plant(address, LinkEnd::kParticipant);
  LcmTransport stranger({address.url, address.channel + "X"}, LinkEnd::kParticipant);
  const Bytes question{1, 2, 3}, answer(kMaxMessageBytes, 7);
  Bytes received;

  master.send(question.data(), question.size());
  ASSERT_TRUE(plant.receive(received, milliseconds{2000}));
  EXPECT_EQ(received, question);
  plant.send(answer.data(), answer.size());
  ASSERT_TRUE(master.receive(received, milliseconds{2000}));
  EXPECT_EQ(received, answer);
  EXPECT_FALSE(stranger.receive(received, milliseconds{20}));
  EXPECT_FALSE(plant.receive(received, milliseconds{0}));
  EXPECT_EQ(master.describe(), address.url + ", channel " + address.channel);
}

TEST(LcmTransport, PrivateAddressesStayOnThisMachineAndDiffer) {
  const LcmAddress a = privateLcmAddress(), b = privateLcmAddress();
  EXPECT_NE(a.channel, b.channel);
  EXPECT_THAT(a.url, testing::EndsWith("?ttl=0"));
  EXPECT_THAT(sharedLcmAddress().url, testing::EndsWith("?ttl=0"));
}

TEST(LcmTransport, APortInUseIsNotFree) {
  const LcmAddress address = privateLcmAddress();
  LcmTransport user(address, LinkEnd::kMaster);
  for (int i = 0; i < 300; ++i) {
    EXPECT_NE("239.255.76.67:" + std::to_string(freeUdpPort()),
              LcmUrl::parse(address.url).network());
  }
}

TEST(LcmTransport, SaysWhatIsWrongWithAnAddress) {
  const auto open = [](const std::string& url, const std::string& channel) {
    return wordsOf<InputError>([&] { LcmTransport({url, channel}, LinkEnd::kMaster); });
  };
  EXPECT_THAT(open("udpm://127.0.0.1:7667", "A"), HasSubstr("not a multicast address"));
  EXPECT_THAT(open("udpm://239.255.76.67", "A"), HasSubstr("no port"));
  EXPECT_THAT(open("udpm://239.255.76.67:70000", "A"), HasSubstr("the port must be 1 to 65535"));
  EXPECT_THAT(open("udpm://localhost:7667", "A"), HasSubstr("'localhost' is no IPv4 address"));
  EXPECT_THAT(
      open("carrier-pigeon://", "A"),
      HasSubstr("LCM cannot use the URL 'carrier-pigeon://'; it must begin with udpm://. Try: "
                "udpm://239.255.76.67"));
  EXPECT_THAT(open("", "A"), HasSubstr("LCM cannot use the URL ''"));
  EXPECT_THAT(open(sharedLcmAddress().url, "A.*"), HasSubstr("out of A-Z a-z 0-9 _ -"));
  EXPECT_THAT(open(sharedLcmAddress().url, ""), HasSubstr("must be 1 to 48 characters"));
}

TEST(LcmTransport, TwoProcessesGiveTheDigestOfOne) {
  const LcmAddress address = privateLcmAddress();
  SpringProcess plant(address);
  LcmTransport transport(address, LinkEnd::kMaster);
  RemoteParticipant remote(transport, remoteOptions());
  EXPECT_EQ(SpringRun(remote).finish(), digestInMemory());
  EXPECT_EQ(plant.wait(), 0);
}

TEST(LcmTransport, APlantThatIsKilledAndReplacedInTheMiddleChangesNothing) {
  const LcmAddress address = privateLcmAddress();
  SpringProcess first(address);
  LcmTransport transport(address, LinkEnd::kMaster);
  RemoteParticipant remote(transport, remoteOptions());
  SpringRun run(remote);
  run.master.initialize();
  for (int i = 0; i < 120; ++i) ASSERT_TRUE(run.master.step());
  const Checkpoint checkpoint = run.master.save();
  first.kill();

  SpringProcess second(address);
  RemoteParticipant fresh(transport, remoteOptions());
  run.master.replaceParticipant(fresh);
  run.master.restore(checkpoint);
  EXPECT_EQ(run.finish(), digestInMemory());
  EXPECT_EQ(second.wait(), 0);
}

TEST(LcmTransport, AKilledPlantIsNamed) {
  const LcmAddress address = privateLcmAddress();
  SpringProcess plant(address);
  LcmTransport transport(address, LinkEnd::kMaster);
  RemoteOptions options = remoteOptions();
  options.patience = milliseconds{300};
  RemoteParticipant remote(transport, options);
  SpringRun run(remote);
  run.master.initialize();
  run.master.step();
  plant.kill();
  EXPECT_THAT(wordsOf<LostParticipantError>([&] { run.master.run(); }),
              HasSubstr("no reply from 'plant' within"));
}

TEST(LcmTransport, TwoPlantsOnOneChannelAreNoticed) {
  const LcmAddress address = privateLcmAddress();
  SpringProcess one(address), two(address);
  LcmTransport transport(address, LinkEnd::kMaster);
  RemoteParticipant remote(transport, remoteOptions());
  SpringRun run(remote);
  EXPECT_THAT(wordsOf<InputError>([&] { run.master.run(); }),
              HasSubstr("two processes answer as 'plant' on " + address.url));
}

TEST(LcmTransport, ASecondRunOnTheChannelIsToldSo) {
  const LcmAddress address = privateLcmAddress();
  SpringProcess plant(address);
  LcmTransport first_end(address, LinkEnd::kMaster), second_end(address, LinkEnd::kMaster);
  RemoteParticipant first(first_end, remoteOptions()), second(second_end, remoteOptions());
  SpringRun run(first);
  run.master.initialize();
  run.master.step();
  EXPECT_THAT(wordsOf<InputError>([&] { second.enterInitializationMode(kSimStart); }),
              HasSubstr("spring is in use by another run"));
  EXPECT_EQ(run.finish(), digestInMemory());
}

TEST(Relay, ALossyLineChangesNoBit) {
  const LcmAddress near = privateLcmAddress();
  const LcmAddress far{privateLcmAddress().url, near.channel};
  SpringProcess plant(far);

  std::atomic<bool> stop{false}, listening{false};
  RelayOptions options;
  options.master_url = near.url;
  options.participant_url = far.url;
  options.channel = near.channel;
  options.disturbance.loss = 0.2;
  options.disturbance.duplication = 0.2;
  options.disturbance.reordering = 0.3;
  options.stop = &stop;
  options.listening = &listening;
  RelayReport report;
  std::thread relaying([&] { report = relay(options); });
  while (!listening) std::this_thread::sleep_for(milliseconds{1});

  LcmTransport transport(near, LinkEnd::kMaster);
  {
    RemoteParticipant remote(transport, remoteOptions());
    EXPECT_EQ(SpringRun(remote).finish(), digestInMemory());
    EXPECT_GT(remote.statistics().repeated, 50);
  }
  stop = true;
  relaying.join();
  EXPECT_GT(report.requests.lost, 20);
  EXPECT_GT(report.replies.lost, 20);
  EXPECT_GT(report.requests.duplicated, 20);
  EXPECT_GT(report.replies.held_back, 20);
  // All but those that were still held back at the end.
  const std::int64_t due =
      report.requests.received - report.requests.lost + report.requests.duplicated;
  EXPECT_LE(report.requests.sent, due);
  EXPECT_GE(report.requests.sent, due - 5);
}

TEST(Relay, NeedsTwoNetworks) {
  RelayOptions options;
  options.master_url = "udpm://239.255.76.67:7667?ttl=0";
  options.participant_url = "udpm://239.255.76.67:7667?ttl=1";
  EXPECT_THAT(wordsOf<InputError>([&] { relay(options); }),
              HasSubstr("both sides of the relay are the LCM network 239.255.76.67:7667"));
}

}  // namespace
}  // namespace ballbot
