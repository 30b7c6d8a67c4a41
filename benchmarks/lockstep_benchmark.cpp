// One communication step over LCM, against the bare exchange of two LCM messages of the same size
// between the same two processes on the same core. The participant computes nothing.
#include <csignal>
#include <cstring>
#include <memory>

#include <benchmark/benchmark.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_transport.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/memory_transport.hpp"
#include "cosim/recorder.hpp"
#include "cosim/remote_participant.hpp"
#include "cosim/serve.hpp"
#include "cosim/step_client.hpp"
#include "cosim/step_master.hpp"
#include "cosim/step_server.hpp"

namespace {

using namespace ballbot;

constexpr SimDuration kStepLength{400'000};

/// Knows its time and nothing else.
class IdleParticipant final : public Participant {
 public:
  std::string name() const override { return "idle"; }
  void enterInitializationMode(SimTime start) override { sensors_.time = start; }
  void exitInitializationMode() override {}
  void doStep(SimTime now, SimDuration step, const ActuatorCommand&) override {
    sensors_.time = now + step;
  }
  void terminate() override {}
  void reset() override {}
  const SensorFrame& sensors() const override { return sensors_; }
  std::optional<TruthFrame> truth() const override {
    TruthFrame truth;
    truth.time = sensors_.time;
    return truth;
  }
  StateBlob saveState() const override { return {}; }
  void restoreState(const StateBlob&) override {}
  std::uint64_t stateDigest() const override { return 1; }

 private:
  SensorFrame sensors_;
};

class IdleController final : public SteppedController {
 public:
  void onSensors(SimTime, const SensorFrame&, DueTasks, ControlOutput&) noexcept override {}
  StateBlob saveState() const override { return {}; }
  void restoreState(const StateBlob&) override {}
};

/// In a lockstep the two sides never work at once: both on one core is fastest.
class PinnedToOneCore {
 public:
  PinnedToOneCore() {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int core = CPU_SETSIZE - 1; core >= 0; --core) {
      if (CPU_ISSET(core, &before_)) {
        CPU_SET(core, &one);
        break;
      }
    }
    sched_setaffinity(0, sizeof one, &one);
  }
  ~PinnedToOneCore() { sched_setaffinity(0, sizeof before_, &before_); }

 private:
  cpu_set_t before_;
};

/// Does `work` in a process of its own until it is destroyed.
class Child {
 public:
  template <typename Work>
  explicit Child(Work&& work) : pid_(::fork()) {
    if (pid_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    work();
    ::_exit(0);
  }
  ~Child() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }

 private:
  pid_t pid_;
};

/// Sizes of what a step sends and gets back.
std::pair<Bytes, Bytes> messagesOfAStep() {
  IdleParticipant idle;
  StepServer server(idle, 1, 1);
  StepClient client(1, 1);
  const Bytes& hello = client.hello(kSimStart);
  const Bytes* answer = server.receive(hello.data(), hello.size());
  client.receive(answer->data(), answer->size());
  const Bytes request = client.step(kSimStart, kStepLength, {});
  return {request, *server.receive(request.data(), request.size())};
}

void lcmPingPong(benchmark::State& state) {
  const PinnedToOneCore pinned;
  const auto [request, reply] = messagesOfAStep();
  const LcmAddress address = privateLcmAddress();
  const Child echo([&, answer = reply]() mutable {
    LcmBus bus(address.url);
    bus.subscribe("PING");
    const LcmBus::Message* message = nullptr;
    for (;;) {
      if (!bus.receive(message, std::chrono::seconds{1})) continue;
      std::memcpy(answer.data(), message->data.data(), sizeof(std::int64_t));
      bus.publish("PONG", answer.data(), answer.size());
    }
  });
  LcmBus bus(address.url);
  bus.subscribe("PONG");
  // Numbered, so that a late answer from the start never lets two be under way at once.
  auto exchange = [&, ping = request, number = std::int64_t{0}](WallDuration wait) mutable {
    ++number;
    std::memcpy(ping.data(), &number, sizeof number);
    bus.publish("PING", ping.data(), ping.size());
    const LcmBus::Message* message = nullptr;
    while (bus.receive(message, wait)) {
      if (std::memcmp(message->data.data(), &number, sizeof number) == 0) return true;
    }
    return false;
  };
  while (!exchange(std::chrono::milliseconds{20})) {
  }
  for (auto _ : state) {
    while (!exchange(std::chrono::milliseconds{200})) {
    }
  }
  state.counters["request_bytes"] = static_cast<double>(request.size());
  state.counters["reply_bytes"] = static_cast<double>(reply.size());
}

void lockstepRoundTrip(benchmark::State& state) {
  const PinnedToOneCore pinned;
  const LcmAddress address = privateLcmAddress();
  const Child plant([&] {
    IdleParticipant idle;
    LcmTransport transport(address, LinkEnd::kParticipant);
    serve(idle, transport, {});
  });
  LcmTransport transport(address, LinkEnd::kMaster);
  RemoteParticipant remote(transport, {});
  remote.enterInitializationMode(kSimStart);
  ActuatorCommand command;
  SimTime now = kSimStart;
  for (auto _ : state) {
    remote.doStep(now, kStepLength, command);
    now += kStepLength;
  }
  state.counters["repeated"] = static_cast<double>(remote.statistics().repeated);
  remote.terminate();
}

// What the protocol itself computes in one round trip: both machines, without any transport.
void protocolMachines(benchmark::State& state) {
  IdleParticipant idle;
  StepServer server(idle, 1, 1);
  StepClient client(1, 1);
  const auto exchange = [&](const Bytes& request) {
    const Bytes* reply = server.receive(request.data(), request.size());
    client.receive(reply->data(), reply->size());
  };
  exchange(client.hello(kSimStart));
  ActuatorCommand command;
  SimTime now = kSimStart;
  for (auto _ : state) {
    exchange(client.step(now, kStepLength, command));
    now += kStepLength;
  }
}

// One event of a run in one process: master, digest, and the log where it says so.
void masterEvent(benchmark::State& state, const char* log_path) {
  IdleParticipant idle;
  Lifecycle guarded(idle);
  IdleController controller;
  EventCalendar calendar;
  calendar.addTask("tracker", kStepLength);
  calendar.addTask("estimator", SimDuration{2'500'000});
  RecorderOptions options;
  options.log_path = log_path;
  Recorder recorder(options);
  StepMaster master(guarded, controller, calendar, &recorder,
                    {kSimStart, kSimStart + std::chrono::hours{1000}});
  master.initialize();
  for (auto _ : state) master.step();
}

}  // namespace

BENCHMARK(lcmPingPong)->Name("lcm_ping_pong")->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(lockstepRoundTrip)
    ->Name("lockstep_round_trip")
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(protocolMachines)->Name("lockstep_machines")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(masterEvent, digest, "")
    ->Name("master_event/digest")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(masterEvent, log, "/dev/null")
    ->Name("master_event/log")
    ->Unit(benchmark::kMicrosecond);
