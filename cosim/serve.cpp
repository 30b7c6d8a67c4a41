#include "cosim/serve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "ballbot_msgs/step_reply.hpp"
#include "ballbot_msgs/step_request.hpp"
#include "core/error.hpp"
#include "core/printable_text.hpp"
#include "cosim/session_id.hpp"
#include "cosim/step_server.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;

// A signal may come just before poll() begins; so often its flag is looked at anyway.
constexpr milliseconds kStopInterval{200};
constexpr milliseconds kProbeInterval{50};

/// A StepServer with a clock and a transport around it.
class Host {
 public:
  Host(Participant& participant, Transport& transport, const ServeOptions& options)
      : name_(participant.name()),
        transport_(transport),
        options_(options),
        server_(participant, options.config_digest, drawSessionId()) {
    if (options.busy == nullptr) return;
    options.busy->connect([this](const std::string& doing) {
      const Bytes* word = server_.stillWorking(doing);
      transport_.send(word->data(), word->size());
    });
  }
  ~Host() {
    if (options_.busy != nullptr) options_.busy->connect({});
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  ServeReport serve() {
    say("waiting on " + transport_.describe());
    for (;;) {
      listen();
      if (options_.stop != nullptr && options_.stop->load()) {
        sayFarewell();
        return report(ServeEnd::kInterrupted);
      }
      if (!sessionIsOver()) continue;
      const Session ended = server_.session();
      if (ended == Session::kNone || ended == Session::kOpen) masterIsSilent();
      if (ended == Session::kAborted) say("the controller gave up");
      if (!options_.keep_serving) {
        return report(ended == Session::kAborted ? ServeEnd::kAborted : ServeEnd::kFinished);
      }
      server_.drop();
      last_heard_ = now_;
    }
  }

 private:
  using Session = StepServer::Session;

  // Waits for one message and answers it.
  void listen() {
    const bool any = transport_.receive(request_, kStopInterval);
    now_ = WallClock::now();
    if (options_.news) {
      if (const std::string text = options_.news(); !text.empty()) say(text);
    }
    if (!any) return;
    const std::int64_t served = server_.served();
    const std::int64_t resent = server_.resent();
    const Bytes* reply = server_.receive(request_.data(), request_.size());
    if (reply != nullptr) transport_.send(reply->data(), reply->size());
    // Traffic of other runs is no sign of life of this one's master.
    if (server_.served() + server_.resent() > served + resent) last_heard_ = now_;
    if (server_.served() > served && !server_.lastError().empty()) say(server_.lastError());
  }

  bool sessionIsOver() const {
    if (server_.session() == Session::kReleased) return true;
    const milliseconds limit = patience();
    return limit > milliseconds{0} && now_ - last_heard_ >= limit;
  }

  // Zero: for ever.
  milliseconds patience() const {
    switch (server_.session()) {
      case Session::kNone:
        return server_.served() > 0 ? milliseconds{0} : options_.first_contact;
      case Session::kOpen:
        return options_.idle_timeout;
      case Session::kAborted:
        return std::min(options_.linger, kStopInterval);
      default:
        return options_.linger;
    }
  }

  void masterIsSilent() {
    const std::string text = fmt::format(
        "no request from the controller for {} ms, at {}, on {}. Is it running, and on the same "
        "LCM "
        "URL? Try: ballbot doctor",
        patience().count(), toText(server_.time()), transport_.describe());
    if (!options_.keep_serving) throw LostParticipantError("controller", name_ + ": " + text);
    say(text);
  }

  // The master waits for a reply; better that it hears why none will come.
  void sayFarewell() {
    if (server_.session() != Session::kOpen) return;
    server_.withdraw(name_ + " was stopped by a signal");
    const std::int64_t served = server_.served();
    const WallClock::time_point until = now_ + kStopInterval;
    while (server_.served() == served && now_ < until) listen();
  }

  void say(const std::string& text) const {
    if (options_.say) options_.say(printableText(name_ + ": " + text));
  }
  ServeReport report(ServeEnd end) const { return {end, server_.served(), server_.ignored()}; }

  const std::string name_;
  Transport& transport_;
  const ServeOptions& options_;
  StepServer server_;
  WallClock::time_point now_ = WallClock::now();  // after the last wait
  WallClock::time_point last_heard_ = now_;
  Bytes request_;
};

}  // namespace

ServeReport serve(Participant& participant, Transport& transport, const ServeOptions& options) {
  return Host(participant, transport, options).serve();
}

std::optional<std::string> whoServes(Transport& master_end, WallDuration wait) {
  ballbot_msgs::step_request probe{};
  probe.header.protocol_version = kProtocolVersion;
  probe.header.session = static_cast<std::int64_t>(drawSessionId());
  probe.header.sequence = 1;
  probe.header.kind = ballbot_msgs::step_header::PROBE;
  Bytes question, answer;
  encodeMessage(probe, question);

  // One question alone may be lost, or come while the other is busy starting.
  const WallClock::time_point until = WallClock::now() + wait;
  WallClock::time_point ask_again = WallClock::now();
  ballbot_msgs::step_reply reply{};
  for (WallClock::time_point now = ask_again; now < until; now = WallClock::now()) {
    if (now >= ask_again) {
      master_end.send(question.data(), question.size());
      ask_again = now + kProbeInterval;
    }
    if (!master_end.receive(answer, std::min(ask_again, until) - now)) continue;
    if (!decodeMessage(answer.data(), answer.size(), reply)) continue;
    if (reply.header.session == probe.header.session) return printableText(reply.text);
  }
  return std::nullopt;
}

}  // namespace ballbot
