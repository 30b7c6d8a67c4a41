#pragma once

#include <cstdint>
#include <string>

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "cosim/step_protocol.hpp"
#include "messages/wire.hpp"
#include "model/signals.hpp"

namespace ballbot {

/// The master's end of the step protocol: builds requests and recognises their replies. No clock
/// and no socket; cosim/remote_participant.hpp puts both around it.
///
/// One request is outstanding at a time; pending() may be sent as often as needed. Methods that
/// build a request need the reply to the one before, except abort.
class StepClient {
 public:
  /// @param session a number no other run has; not 0.
  StepClient(std::int64_t session, std::uint64_t config_digest);

  const Bytes& hello(SimTime start);
  const Bytes& step(SimTime now, SimDuration step, const ActuatorCommand& command);
  const Bytes& save(std::size_t offset);
  const Bytes& restore(const StateBlob& blob, std::size_t offset);
  const Bytes& reset(SimTime start);
  const Bytes& bye();
  /// After the reply to bye: tells the far end that it need not wait for a repeated bye. No reply
  /// comes.
  const Bytes& farewell();
  const Bytes& abort();

  /// The request that waits for its reply.
  const Bytes& pending() const { return pending_; }
  std::int64_t sequence() const { return sequence_; }
  std::int64_t session() const { return session_; }

  enum class Received : std::uint8_t {
    kReply,         ///< the expected one: see reply()
    kBusy,          ///< the far end is still at work on the request: see busyText()
    kIgnored,       ///< damaged, foreign or old; counted
    kOtherVersion,  ///< the expected one, from a program with other message definitions
    kSecondServer,  ///< from another process than the one that answered before
  };
  Received receive(const std::uint8_t* data, std::size_t size);
  const ballbot_msgs::step_reply& reply() const { return reply_; }

  /// What the far end last said it was at work on; empty once it has replied.
  const std::string& busyText() const { return busy_text_; }

  const IgnoredMessages& ignored() const { return ignored_; }

 private:
  ballbot_msgs::step_request& next(std::int8_t kind, SimTime time);
  const Bytes& finish();

  std::int64_t session_;
  std::uint64_t config_digest_;
  std::int64_t sequence_ = 0;
  bool waiting_ = false;
  std::int64_t server_ = 0;  // the one that answered first
  IgnoredMessages ignored_;
  ballbot_msgs::step_request request_{};
  ballbot_msgs::step_reply reply_{}, candidate_{};
  std::string busy_text_;
  Bytes pending_;
};

}  // namespace ballbot
