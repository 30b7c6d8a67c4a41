#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cosim/busy_signal.hpp"
#include "cosim/participant.hpp"
#include "cosim/step_protocol.hpp"
#include "cosim/transport.hpp"

namespace ballbot {

struct ServeOptions {
  std::uint64_t config_digest = 0;
  /// How long to wait for the first master; zero: for ever.
  std::chrono::milliseconds first_contact{0};
  /// Silence in an open session after which the master counts as lost.
  std::chrono::milliseconds idle_timeout{15'000};
  /// After bye is answered: how long to stay for a master that did not hear it.
  std::chrono::milliseconds linger{1'000};
  /// Serve run after run instead of ending with the first.
  bool keep_serving = false;
  /// Set by a signal handler (SIGINT, SIGTERM): return at once.
  const std::atomic<bool>* stop = nullptr;
  /// Told by the participant while a request takes it long; the master's patience begins anew then.
  BusySignal* busy = nullptr;
  /// Asked while nobody speaks: what a person should know meanwhile; empty where there is nothing.
  std::function<std::string()> news;
  /// Words for a person, e.g. to print on stderr: session opened, session closed, ...
  std::function<void(const std::string&)> say;
};

enum class ServeEnd {
  kFinished,     ///< the master said bye
  kAborted,      ///< the master gave up
  kInterrupted,  ///< the stop flag was set
};

struct ServeReport {
  ServeEnd end = ServeEnd::kFinished;
  std::int64_t served = 0;  ///< requests acted on
  IgnoredMessages ignored;
};

/// Puts a participant at the far end of the step protocol and stays until the run ends.
/// @throw LostParticipantError the master went silent, or never came
ServeReport serve(Participant& participant, Transport& transport, const ServeOptions& options);

/// Asks, over the master's end of a link, whether somebody serves at the other; their name, or
/// nothing after `wait`; asks again while it waits. Call it before serving on an address that
/// others may know:
///     if (auto who = whoServes(master_end)) throw InputError("... is used by " + *who)
std::optional<std::string> whoServes(Transport& master_end,
                                     WallDuration wait = std::chrono::milliseconds{500});

}  // namespace ballbot
