#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "cosim/lcm_transport.hpp"
#include "cosim/participant.hpp"
#include "cosim/remote_participant.hpp"
#include "experiment/child_process.hpp"
#include "experiment/run_config.hpp"
#include "experiment/run_folder.hpp"

namespace ballbot {

/// What the two processes of a run compare before they begin.
std::uint64_t configDigest64(const Scenario& scenario);

/// Where a run's plant lives and how to reach it: in this process, in a child of it, or wherever
/// somebody serves an LCM address.
class PlantLink {
 public:
  struct Options {
    bool in_process = false;
    bool shared = false;  ///< a child is met on the shared address instead of a private one
    LcmAddress address;   ///< empty url: start a child and meet it on a private address
    int core = -1;        ///< processor of the child; -1: any
    std::chrono::milliseconds patience{10'000};  ///< silence after which the plant counts as lost
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string&)> say;  ///< of a plant that is long at work
  };
  PlantLink(const RunConfig& config, const RunFolder& folder, Options options);
  /// Ends the child if it still lives, and clears away what it left if it had nothing to say.
  ~PlantLink();

  Participant& participant();
  /// Kills the plant and puts a new one, in state instantiated, in its place.
  void replace();
  /// After the run: waits for the child to end by itself.
  void close();

  /// Requests sent and sent again; zeros in process.
  RemoteParticipant::LinkStatistics statistics() const;

 private:
  void start();
  std::string troubleOfChild();

  const RunConfig& config_;
  const RunFolder& folder_;
  Options options_;
  std::string stderr_path_;
  std::unique_ptr<Participant> local_;
  std::unique_ptr<ChildProcess> child_;
  std::unique_ptr<LcmTransport> transport_;
  std::unique_ptr<RemoteParticipant> remote_;
};

}  // namespace ballbot
