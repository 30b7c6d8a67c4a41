#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cosim/lifecycle.hpp"
#include "cosim/step_protocol.hpp"
#include "messages/wire.hpp"

namespace ballbot {

/// The participant's end of the step protocol: bytes in, at most one reply out. No clock and no
/// socket; cosim/serve.hpp puts both around it.
///
/// In the open session the last request again gets the last reply again, the next one is acted on
/// once, an older one and any of another session is ignored and counted, and one that leaves a
/// number out is answered as misused. Errors of the participant become replies in words.
class StepServer {
 public:
  enum class Session : std::uint8_t {
    kNone,      ///< none yet, or dropped
    kOpen,      ///< from hello on
    kClosed,    ///< bye answered; it may be asked again
    kReleased,  ///< the master knows that it is closed
    kAborted,   ///< the master gave up because of an error
  };

  /// @param participant in state instantiated, not wrapped in a Lifecycle; must outlive this.
  /// @param config_digest of the run's configuration; a hello with another is refused.
  /// @param server_id a number that no other serving process has.
  StepServer(Participant& participant, std::uint64_t config_digest, std::uint64_t server_id);

  /// Takes one received message. Returns the reply to send, or null. Valid until the next call.
  const Bytes* receive(const std::uint8_t* data, std::size_t size);

  Session session() const { return session_; }
  /// The time the participant has reached.
  SimTime time() const { return participant_.time(); }
  const IgnoredMessages& ignored() const { return ignored_; }
  /// Requests acted on, and replies sent again because their request came again.
  std::int64_t served() const { return served_; }
  std::int64_t resent() const { return resent_; }
  /// Error of the participant in the last request, empty if none.
  const std::string& lastError() const { return last_error_; }

  /// Ends the session from this side, e.g. after a long silence; the participant is reset when the
  /// next hello comes.
  void drop();
  /// While a request is acted on: tells the master, between two replies, that it is. Valid until
  /// the next call.
  const Bytes* stillWorking(const std::string& doing);
  /// From now on every further request is answered as failed, with these words, and not acted on:
  /// this process is about to end.
  void withdraw(const std::string& why) { withdrawn_ = why; }

 private:
  const Bytes* continueSession(const ballbot_msgs::step_header& header);
  const Bytes* judgeHello(const ballbot_msgs::step_header& header);
  const Bytes* act(const ballbot_msgs::step_header& header);
  void perform(std::int8_t kind);
  void start(SimTime time);
  void close(Session how);
  void giveChunk();
  void takeChunk();
  void fillReply(const ballbot_msgs::step_header& header, std::int8_t status,
                 const std::string& text);
  const Bytes* answerOutside(const ballbot_msgs::step_header& header, std::int8_t status,
                             const std::string& text);
  bool retired(std::int64_t session) const;

  Lifecycle participant_;
  std::uint64_t config_digest_, server_id_;
  Session session_ = Session::kNone;
  std::int64_t session_id_ = 0, sequence_ = 0;
  std::vector<std::int64_t> retired_;
  IgnoredMessages ignored_;
  std::int64_t served_ = 0, resent_ = 0;
  std::string last_error_, withdrawn_;

  StateBlob snapshot_;  // being sent by SAVE
  StateBlob incoming_;  // being collected by RESTORE
  ballbot_msgs::step_request request_{};
  ballbot_msgs::step_reply reply_{};
  Bytes last_reply_;     // kept for a repeated request
  Bytes outside_reply_;  // to requests that are no part of the session
};

}  // namespace ballbot
