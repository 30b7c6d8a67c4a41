// Programs that listen on LCM, while a stranger sends to the same address what once ended them.
#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include "cosim/lcm_transport.hpp"
#include "cosim/step_client.hpp"
#include "tests/cosim/support/stranger.hpp"
#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing_support::fragment;
using testing_support::Stranger;

const std::vector<std::string> kShort = {"--set", "duration_s=0.5"};

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string digestOf(const std::vector<std::string>& arguments) {
  const Finished run = runBallbot(with(arguments, {"--quiet", "--json", "--no-report"}));
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << run.err;
  return json.is_discarded() ? run.err : json.at("trajectory_digest").get<std::string>();
}

/// Parts of long messages on both channels, a thousand of each a second.
class Attack {
 public:
  explicit Attack(const LcmAddress& address)
      : stranger_(address.url), thread_([this, address] {
          while (!stop_) {
            for (const char* suffix : {kRequestSuffix, kReplySuffix}) {
              stranger_.send(fragment(100, 0xFFFFFFF0, 1, 2, address.channel + suffix));
              stranger_.send(fragment(0xFFFFFFF0, 0, 0, 2, address.channel + suffix));
              stranger_.send({'L', 'C', '0', '2', 0, 0, 0, 1, 'A'});
            }
            std::this_thread::sleep_for(milliseconds{1});
          }
        }) {}
  ~Attack() {
    stop_ = true;
    thread_.join();
  }

 private:
  Stranger stranger_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

bool waitFor(const std::function<bool()>& what) {
  for (int i = 0; i < 2000; ++i) {
    if (what()) return true;
    std::this_thread::sleep_for(milliseconds{5});
  }
  return false;
}

TEST(HostilePeers, EndNoProgramAndChangeNoBit) {
  const TemporaryFolder folder;
  const LcmAddress address = privateLcmAddress();
  const std::vector<std::string> meeting = {"--lcm-url", address.url, "--channel", address.channel};
  Program plant(with(with({"plant", scenarioPath("balance")}, kShort), meeting));
  Program view(with(with({"view", "--live", scenarioPath("balance")}, kShort), meeting));
  ASSERT_TRUE(waitFor([&] { return plant.errSoFar().find("waiting on") != std::string::npos; }));
  ASSERT_TRUE(waitFor([&] { return view.errSoFar().find("Ctrl-C") != std::string::npos; }));
  const auto quiet = digestOf(
      with({"run", scenarioPath("balance"), "--in-process", "--out", folder / "quiet"}, kShort));
  const Attack attack(address);
  EXPECT_EQ(
      digestOf(with(with({"run", scenarioPath("balance"), "--out", folder / "attacked"}, kShort),
                    meeting)),
      quiet);
  EXPECT_EQ(plant.finish(20).exit_code, 0);
  view.signal(SIGINT);
  EXPECT_EQ(view.finish(20).exit_code, 0);
}

TEST(HostilePeers, AskingForALongStepDoNotKeepThePlantFromEnding) {
  const LcmAddress address = privateLcmAddress();
  Program plant(
      {"plant", scenarioPath("balance"), "--lcm-url", address.url, "--channel", address.channel});
  ASSERT_TRUE(waitFor([&] { return plant.errSoFar().find("waiting on") != std::string::npos; }));
  // Any configuration is refused in words that name the right one; that is how to get in.
  LcmTransport transport(address, LinkEnd::kMaster);
  Bytes heard;
  const auto answerTo = [&](StepClient& client) {
    for (int i = 0; i < 50; ++i) {
      transport.send(client.pending().data(), client.pending().size());
      if (transport.receive(heard, milliseconds{100}) &&
          client.receive(heard.data(), heard.size()) == StepClient::Received::kReply) {
        return client.reply();
      }
    }
    ADD_FAILURE() << "no reply";
    return ballbot_msgs::step_reply{};
  };
  StepClient guess(77, 0);
  guess.hello(kSimStart);
  const std::string refusal = answerTo(guess).text;
  const std::string before = "runs configuration ";
  ASSERT_THAT(refusal, HasSubstr(before));
  const std::uint64_t digest =
      std::stoull(refusal.substr(refusal.find(before) + before.size(), 16), nullptr, 16);
  StepClient client(78, digest);
  client.hello(kSimStart);
  ASSERT_EQ(answerTo(client).status, ballbot_msgs::step_reply::OK);
  client.step(kSimStart, SimDuration{3'600'000'000'000}, {});
  EXPECT_THAT(answerTo(client).text, HasSubstr("a step of 3600 s, at most 1 s is made at once"));
  plant.signal(SIGINT);
  EXPECT_EQ(plant.finish(10).exit_code, 130);
}

// The verb that process `pid` was started with; of a child that was forked and did not call exec
// yet, its parent's.
std::string verbOf(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/cmdline");
  std::string program, verb;
  std::getline(std::getline(in, program, '\0'), verb, '\0');
  return verb;
}

TEST(ChildProcess, OfAKilledRunDiesEvenWhereItIsStopped) {
  const TemporaryFolder folder;
  pid_t plant = -1;
  {
    Program run(
        {"run", scenarioPath("balance"), "--quiet", "--no-report", "--out", folder / "run"});
    // Between fork and exec it asks to die with its parent: one stopped before that never would.
    ASSERT_TRUE(waitFor([&] {
      const std::vector<pid_t> children = run.children();
      if (children.empty()) return false;
      plant = children.front();
      return verbOf(plant) == "plant";
    }));
    ::kill(plant, SIGSTOP);
  }  // killed here
  // As a zombie it is dead, too, where nobody collects it.
  const auto gone = [plant] {
    std::ifstream in("/proc/" + std::to_string(plant) + "/stat");
    std::string pid, name, state;
    return !(in >> pid >> name >> state) || state == "Z" || state == "X";
  };
  EXPECT_TRUE(waitFor(gone));
  if (!gone()) ::kill(plant, SIGKILL);
}

TEST(LcmUrls, ThatMeanNothingAreRefusedByEveryVerb) {
  const std::string url = "udpm://239.255.76.67:7667?ttl=";
  const std::string scenario = scenarioPath("balance");
  for (const char* verb : {"plant", "controller", "run"}) {
    const Finished end = runBallbot({verb, scenario, "--lcm-url", url + "-1"});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_THAT(end.err, HasSubstr("ttl is '-1', must be a whole number from 0 to 255")) << verb;
  }
  EXPECT_EQ(runBallbot({"view", "--live", scenario, "--lcm-url", url + "300"}).exit_code, 2);
  EXPECT_EQ(runBallbot({"relay", url + "0", "udpm://239.255.76.67:7668?tl=1"}).exit_code, 2);
}

}  // namespace
}  // namespace ballbot
