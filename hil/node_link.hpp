#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/canopen_codec.hpp"
#include "hil/drive_setup.hpp"
#include "hil/frame_queue.hpp"
#include "hil/sdo_client.hpp"

namespace ballbot {

/// What a node did that it should not have.
enum class NodeTrouble : std::uint8_t {
  kNone,
  kNoBootUp,      ///< silent after the reset
  kSetupRefused,  ///< an SDO was aborted, timed out or read back another value
  kReboot,        ///< a boot-up message while it was in use
  kLeftOperational,
  kHeartbeatLost,
  kEmergency,
};

/// The master's end of one node: boot-up, set-up by SDO with read-back, network state, heartbeat,
/// emergencies. No clock: cycles are counted by whoever owns it.
class NodeLink {
 public:
  enum class Phase : std::uint8_t { kIdle, kBooting, kConfiguring, kConfigured, kRunning };

  NodeLink(int node, std::vector<SetupStep> setup, int sdo_timeout_cycles, int heartbeat_cycles);

  /// The node was just reset by NMT; it must boot within `patience_cycles`.
  void expectBootUp(int patience_cycles) noexcept;
  /// The node was just started by NMT.
  void start() noexcept;
  /// True if the frame was this node's (and is not a PDO).
  bool onFrame(const CanFrame& frame, FrameQueue& out) noexcept;
  void onCycle(FrameQueue& out) noexcept;

  /// Asks a running node for one object. One question at a time; false if one is open. An `urgent`
  /// one takes the place of another that is open.
  bool ask(ObjectAddress object, bool urgent, FrameQueue& out) noexcept;
  /// Writes one object of a running node, in the place of any question that is open. What comes of
  /// it is an answer, too.
  void tell(ObjectAddress object, std::uint64_t value, std::size_t size, FrameQueue& out) noexcept;
  /// A node that changes its NMT state forgets what it was asked.
  void forgetQuestion() noexcept { asking_ = false; }
  struct Answer {
    ObjectAddress object;
    bool given = false;  ///< false: refused, or silence
    std::uint64_t value = 0;
  };
  /// What came of the last question; once, and nothing while it is open.
  std::optional<Answer> takeAnswer() noexcept;

  int node() const noexcept { return node_; }
  Phase phase() const noexcept { return phase_; }
  NodeTrouble trouble() const noexcept { return trouble_; }
  const Emergency& emergency() const noexcept { return emergency_; }
  /// Which answer is outstanding within a cycle.
  bool awaitsAnswer() const noexcept;
  /// Steps of the set-up that are done, and all of them.
  std::size_t stepsDone() const noexcept { return step_; }
  std::size_t stepCount() const noexcept { return setup_.size(); }
  /// Where the set-up stands: "node 4: 12 of 61, 6072:00 max torque"; "" once it is done.
  std::string progressText() const;
  /// Set-up trouble in words: "6076:00 rated torque in mNm is 5000, configured 20000".
  std::string troubleText() const;

 private:
  void nextStep(FrameQueue& out) noexcept;
  void onTransfer(FrameQueue& out) noexcept;
  void fail(NodeTrouble trouble) noexcept;

  int node_;
  std::vector<SetupStep> setup_;
  SdoClient sdo_;
  int heartbeat_cycles_;
  Phase phase_ = Phase::kIdle;
  NodeTrouble trouble_ = NodeTrouble::kNone;
  std::size_t step_ = 0;
  bool reading_ = false, asking_ = false;
  std::int64_t found_ = 0;
  int waited_ = 0, patience_ = 0;
  bool seen_operational_ = false;
  NmtState left_for_ = NmtState::kBootUp;  ///< of kLeftOperational, whatever it says later
  Emergency emergency_{};
};

}  // namespace ballbot
