#include "cosim/remote_participant.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "cosim/session_id.hpp"
#include "messages/convert.hpp"
#include "model/signal_check.hpp"

namespace ballbot {
namespace {

using Reply = ballbot_msgs::step_reply;
using std::chrono::milliseconds;

// While the far end is still starting nobody is disturbed by frequent tries.
constexpr milliseconds kFirstContactWait{10};

std::int64_t wholeMilliseconds(WallDuration d) {
  return std::chrono::duration_cast<milliseconds>(d).count();
}

}  // namespace

RemoteParticipant::RemoteParticipant(Transport& transport, RemoteOptions options)
    : transport_(transport), options_(std::move(options)) {}

RemoteParticipant::~RemoteParticipant() {
  if (!client_) return;
  client_->abort();
  const auto give_up = WallClock::now() + milliseconds{100};
  while (WallClock::now() < give_up) {
    transport_.send(client_->pending().data(), client_->pending().size());
    if (!transport_.receive(received_, milliseconds{10})) continue;
    if (client_->receive(received_.data(), received_.size()) == StepClient::Received::kReply)
      return;
  }
}

void RemoteParticipant::enterInitializationMode(SimTime start) {
  if (reset_pending_ && client_) {
    client_->reset(start);
    exchange(options_.patience);
  } else {
    client_ = std::make_unique<StepClient>(static_cast<std::int64_t>(drawSessionId()),
                                           options_.config_digest);
    client_->hello(start);
    exchange(options_.first_patience, kFirstContactWait);
  }
  reset_pending_ = false;
  adoptReply(start);
}

void RemoteParticipant::doStep(SimTime now, SimDuration step, const ActuatorCommand& command) {
  client_->step(now, step, command);
  exchange(options_.patience);
  adoptReply(now + step);
}

void RemoteParticipant::terminate() {
  client_->bye();
  exchange(options_.patience);
  const Bytes& farewell = client_->farewell();
  transport_.send(farewell.data(), farewell.size());
  statistics_.ignored = client_->ignored();
  client_.reset();
}

// Acts when the participant is initialised again: the far end knows one request for both.
void RemoteParticipant::reset() { reset_pending_ = true; }

StateBlob RemoteParticipant::saveState() const {
  StateBlob blob;
  std::int32_t whole = 0;
  do {
    client_->save(blob.size());
    exchange(options_.patience);
    const Reply& reply = client_->reply();
    const bool continues = !reply.chunk.empty() &&
                           reply.blob_offset == static_cast<std::int32_t>(blob.size()) &&
                           (blob.empty() || reply.blob_size == whole);
    whole = reply.blob_size;
    blob.insert(blob.end(), reply.chunk.begin(), reply.chunk.end());
    if (!continues || whole > static_cast<std::int32_t>(kMaxStateBytes) ||
        static_cast<std::int32_t>(blob.size()) > whole) {
      throw LostParticipantError(
          options_.name, fmt::format("{} sent {} bytes at {} of {}, no part of its state that "
                                     "continues the {} before",
                                     options_.name, reply.chunk.size(), reply.blob_offset, whole,
                                     blob.size() - reply.chunk.size()));
    }
  } while (static_cast<std::int32_t>(blob.size()) < whole);
  return blob;
}

void RemoteParticipant::restoreState(const StateBlob& blob) {
  if (blob.size() > kMaxStateBytes) {
    throw InputError(fmt::format("saved {} state: {} bytes, at most {} can be sent", options_.name,
                                 blob.size(), kMaxStateBytes));
  }
  for (std::size_t sent = 0; sent < blob.size(); sent += kChunkBytes) {
    client_->restore(blob, sent);
    exchange(options_.patience);
  }
  const std::int64_t reached = client_->reply().time_ns;
  if (reached < 0 || reached > toNs(kLatestTime)) {
    throwUnbelievable(fmt::format("it stands at {} ns", reached));
  }
  adoptReply(simTimeFromNs(reached));
}

RemoteParticipant::LinkStatistics RemoteParticipant::statistics() const {
  LinkStatistics now = statistics_;
  if (client_) now.ignored = client_->ignored();
  return now;
}

// Sends the pending request until its reply is there.
void RemoteParticipant::exchange(WallDuration patience, WallDuration longest_wait) const {
  ++statistics_.requests;
  const WallClock::time_point started = WallClock::now();
  WallClock::time_point now = started;
  patient_since_ = started;
  for (int tries = 0;; ++tries) {
    if (options_.stop != nullptr && options_.stop->load()) {
      throw InterruptedError("stopped while waiting for " + options_.name);
    }
    if (tries > 0) {
      const std::string trouble = options_.peer_trouble ? options_.peer_trouble() : std::string{};
      if (!trouble.empty()) {
        throw LostParticipantError(options_.name, options_.name + " " + trouble);
      }
      if (now - patient_since_ >= patience) throwLost(now - patient_since_, tries);
      ++statistics_.repeated;
    }
    transport_.send(client_->pending().data(), client_->pending().size());
    const bool replied = replyBy(now + std::min(timer_.wait(tries), longest_wait), now);
    if (!replied) continue;
    if (tries == 0) timer_.measured(now - started);
    return throwUnlessOk();
  }
}

// `now` is the time on entry and on return.
bool RemoteParticipant::replyBy(WallClock::time_point until, WallClock::time_point& now) const {
  while (now < until) {
    const bool any = transport_.receive(received_, until - now);
    now = WallClock::now();
    if (!any) {
      if (options_.stop != nullptr && options_.stop->load()) return false;
      continue;
    }
    switch (client_->receive(received_.data(), received_.size())) {
      case StepClient::Received::kReply:
        return true;
      case StepClient::Received::kBusy:
        patient_since_ = now;
        if (options_.say) options_.say(client_->busyText());
        break;
      case StepClient::Received::kIgnored:
        break;
      case StepClient::Received::kOtherVersion:
        throw InputError(fmt::format(
            "{} answers with other message definitions than this program's. Build both from the "
            "same sources.",
            options_.name));
      case StepClient::Received::kSecondServer:
        throw InputError(fmt::format(
            "two processes answer as '{}' on {}. Stop one, or give each run a channel of its own.",
            options_.name, transport_.describe()));
    }
  }
  return false;
}

// Whoever knows the session may answer, and the far end may be ill: what it says is looked at
// before an estimator integrates up to it.
void RemoteParticipant::adoptReply(SimTime expected) {
  const Reply& reply = client_->reply();
  if (reply.time_ns != toNs(expected)) {
    throwUnbelievable(
        fmt::format("it stands at {} ns and was asked for {} ns", reply.time_ns, toNs(expected)));
  }
  if (!fromMessage(reply.sensors, sensors_)) {
    throwUnbelievable(fmt::format("it has sensors of {} joints, the robot has {}",
                                  reply.sensors.joints, kJointCount));
  }
  const std::string bad_sensor = firstImpossible(sensors_, expected);
  if (!bad_sensor.empty()) throwUnbelievable(bad_sensor);
  adoptAdded(AddedTo::kSensors, reply.added);
  state_digest_ = static_cast<std::uint64_t>(reply.state_digest);
  if (reply.truth_count == 1) {
    if (!truth_) truth_.emplace();
    if (!fromMessage(reply.truth[0], *truth_)) {
      throwUnbelievable(fmt::format("it has the truth of {} joints, the robot has {}",
                                    reply.truth[0].joints, kJointCount));
    }
    const std::string bad_truth = firstImpossible(*truth_, expected);
    if (!bad_truth.empty()) throwUnbelievable(bad_truth);
    adoptAdded(AddedTo::kTruth, reply.truth_added);
  } else {
    truth_.reset();
  }
}

void RemoteParticipant::adoptAdded(AddedTo frame, const std::vector<double>& values) {
  AddedSignals& added = options_.added[frame];
  const char* beside = frame == AddedTo::kTruth ? "truth" : "sensors";
  if (values.size() != added.list.size()) {
    throwUnbelievable(fmt::format("{} values beside its {}, and the configuration has {}",
                                  values.size(), beside, added.list.size()));
  }
  added.values = values;
  const std::string bad = firstNonFinite(added);
  if (!bad.empty()) throwUnbelievable(fmt::format("beside its {}, {}", beside, bad));
}

void RemoteParticipant::throwUnbelievable(const std::string& what) const {
  throw NumericalError(fmt::format(
      "{} answered request {} with what cannot be: {}. It came over {}, where anybody may send; is "
      "it the {} you started?",
      options_.name, client_->sequence(), what, transport_.describe(), options_.name));
}

void RemoteParticipant::throwUnlessOk() const {
  const Reply& reply = client_->reply();
  if (reply.status == Reply::OK) return;
  const std::string text = reply.text.empty()
                               ? fmt::format("{} refused request {} and did not say why",
                                             options_.name, client_->sequence())
                               : reply.text;
  if (reply.status == Reply::REFUSED) {
    client_.reset();  // there is no session to abort
    throw InputError(text);
  }
  if (reply.status == Reply::FAILED) {
    switch (static_cast<ExitCode>(reply.exit_code)) {
      case ExitCode::kBadInput:
        throw InputError(text);
      case ExitCode::kOutputFailed:
        throw OutputError(text);
      case ExitCode::kInterrupted:
        throw InterruptedError(text);
      case ExitCode::kTorqueNotOff:
        throw TorqueNotOffError(text);
      default:
        break;
    }
  }
  throw LostParticipantError(options_.name, text);
}

void RemoteParticipant::throwLost(WallDuration waited, int tries) const {
  std::string hint;
  if (!client_->busyText().empty()) hint = " The last it said: " + client_->busyText() + ".";
  if (client_->ignored().foreign > 0) {
    hint += fmt::format(" {} messages of another run came instead: is the channel in use twice?",
                        client_->ignored().foreign);
  }
  throw LostParticipantError(
      options_.name,
      fmt::format("no reply from '{}' within {} ms ({} tries of request {}), on {}. Is it running, "
                  "and on the same LCM URL?{} Try: ballbot doctor",
                  options_.name, wholeMilliseconds(waited), tries, client_->sequence(),
                  transport_.describe(), hint));
}

}  // namespace ballbot
