#include "cosim/step_server.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"
#include "messages/convert.hpp"

namespace ballbot {

using Header = ballbot_msgs::step_header;
using Reply = ballbot_msgs::step_reply;

StepServer::StepServer(Participant& participant, std::uint64_t config_digest,
                       std::uint64_t server_id)
    : participant_(participant), config_digest_(config_digest), server_id_(server_id) {}

const Bytes* StepServer::receive(const std::uint8_t* data, std::size_t size) {
  Header header{};
  if (!decodeHeader(data, size, header)) {
    ++ignored_.damaged;
    return nullptr;
  }
  const bool same_version = fingerprint(data, size) == ballbot_msgs::step_request::getHash() &&
                            header.protocol_version == kProtocolVersion;
  if (!same_version) {
    // Only the header means the same to both, and that is enough to refuse in words.
    if (header.kind == Header::HELLO) {
      return answerOutside(
          header, Reply::REFUSED,
          fmt::format("{} speaks version {} of the step protocol and its messages, the master "
                      "another (it says {}). Build both from the same sources.",
                      participant_.name(), kProtocolVersion, header.protocol_version));
    }
    ++ignored_.foreign;
    return nullptr;
  }
  if (!decodeWhole(data, size, request_)) {
    ++ignored_.damaged;
    return nullptr;
  }
  if (header.kind == Header::PROBE) return answerOutside(header, Reply::OK, participant_.name());
  if (session_ != Session::kNone && header.session == session_id_) return continueSession(header);
  if (header.kind != Header::HELLO || header.sequence != 1 || header.session == 0 ||
      retired(header.session)) {
    ++ignored_.foreign;
    return nullptr;
  }
  return judgeHello(header);
}

const Bytes* StepServer::continueSession(const Header& header) {
  if (header.sequence == sequence_) {
    ++resent_;
    return &last_reply_;
  }
  if (header.sequence < sequence_) {
    ++ignored_.old;
    return nullptr;
  }
  if (session_ != Session::kOpen) {
    if (session_ == Session::kClosed && header.kind == Header::BYE) session_ = Session::kReleased;
    return nullptr;
  }
  // An abort may leave numbers out: who gives up does not wait for replies.
  if (header.sequence > sequence_ + 1 && header.kind != Header::ABORT) {
    return answerOutside(header, Reply::MISUSED,
                         fmt::format("{}: request {} came after {}, one was left out",
                                     participant_.name(), header.sequence, sequence_));
  }
  return act(header);
}

const Bytes* StepServer::judgeHello(const Header& header) {
  if (request_.message_digest != messageDigest()) {
    return answerOutside(header, Reply::REFUSED,
                         fmt::format("{} and its master were built with different message "
                                     "definitions. Build both from the same sources.",
                                     participant_.name()));
  }
  if (static_cast<std::uint64_t>(request_.config_digest) != config_digest_) {
    return answerOutside(
        header, Reply::REFUSED,
        fmt::format("{} runs configuration {:016x}, its master {:016x}. Start both with the same "
                    "scenario and the same --set options.",
                    participant_.name(), config_digest_,
                    static_cast<std::uint64_t>(request_.config_digest)));
  }
  if (session_ == Session::kOpen) {
    return answerOutside(header, Reply::REFUSED,
                         fmt::format("{} is in use by another run, now at {}. Wait for its end, or "
                                     "start both processes on a channel of their own.",
                                     participant_.name(), toText(participant_.time())));
  }
  drop();
  session_ = Session::kOpen;
  session_id_ = header.session;
  return act(header);
}

// Acts on a request that is next in the session, once, and keeps the reply.
const Bytes* StepServer::act(const Header& header) {
  sequence_ = header.sequence;
  ++served_;
  last_error_.clear();
  reply_.exit_code = 0;
  reply_.blob_size = reply_.blob_offset = reply_.chunk_size = 0;
  reply_.chunk.clear();
  std::int8_t status = Reply::OK;
  try {
    if (!withdrawn_.empty()) throw Error(ExitCode::kLostParticipant, withdrawn_);
    perform(header.kind);
  } catch (const Error& error) {
    status = Reply::FAILED;
    reply_.exit_code = static_cast<std::int8_t>(error.exitCode());
    last_error_ = error.what();
  } catch (const std::logic_error& error) {
    status = Reply::MISUSED;
    last_error_ = error.what();
  } catch (const std::exception& error) {
    status = Reply::FAILED;
    reply_.exit_code = static_cast<std::int8_t>(ExitCode::kLostParticipant);
    last_error_ = fmt::format("{}: {}", participant_.name(), error.what());
  }
  fillReply(header, status, last_error_);
  encodeMessage(reply_, last_reply_);
  return &last_reply_;
}

void StepServer::perform(std::int8_t kind) {
  const SimTime time = simTimeFromNs(request_.time_ns);
  if (time < kSimStart || time > kLatestTime) {
    throw std::logic_error(fmt::format("{} at {}, must be 0 s to {}", requestName(kind),
                                       toText(time), toText(kLatestTime)));
  }
  switch (kind) {
    case Header::HELLO:
      if (sequence_ != 1)
        throw std::logic_error("hello within an open session; reset starts again");
      return start(time);
    case Header::STEP: {
      const SimDuration step{request_.step_ns};
      if (step > kLongestStep) {
        throw std::logic_error(fmt::format("a step of {}, at most {} is made at once", toText(step),
                                           toText(kLongestStep)));
      }
      ActuatorCommand command;
      if (!fromMessage(request_.command, command)) {
        throw std::logic_error(fmt::format("a command for {} joints, the robot has {}",
                                           request_.command.joints, kJointCount));
      }
      return participant_.doStep(time, step, command);
    }
    case Header::SAVE:
      return giveChunk();
    case Header::RESTORE:
      return takeChunk();
    case Header::RESET:
      return start(time);
    case Header::BYE:
      return close(Session::kClosed);
    case Header::ABORT:
      return close(Session::kAborted);
    default:
      throw std::logic_error(fmt::format("{} is no kind of request", kind));
  }
}

void StepServer::start(SimTime time) {
  if (participant_.state() != LifecycleState::kInstantiated) participant_.reset();
  participant_.initialize(time);
}

// The session ends even if the participant cannot.
void StepServer::close(Session how) {
  session_ = how;
  if (participant_.state() == LifecycleState::kStep) participant_.terminate();
}

void StepServer::giveChunk() {
  if (request_.blob_offset == 0) snapshot_ = participant_.saveState();
  if (snapshot_.size() > kMaxStateBytes) {
    throw Error(ExitCode::kLostParticipant,
                fmt::format("{}: its state has {} bytes, at most {} can be sent",
                            participant_.name(), snapshot_.size(), kMaxStateBytes));
  }
  const auto offset = static_cast<std::size_t>(request_.blob_offset);
  if (offset > snapshot_.size()) {  // negative ones are huge
    throw std::logic_error(
        fmt::format("save from byte {} of a state of {}", request_.blob_offset, snapshot_.size()));
  }
  const std::uint8_t* from = snapshot_.data() + offset;
  const std::size_t count = std::min(kChunkBytes, snapshot_.size() - offset);
  reply_.chunk.assign(from, from + count);
  reply_.chunk_size = static_cast<std::int32_t>(count);
  reply_.blob_offset = request_.blob_offset;
  reply_.blob_size = static_cast<std::int32_t>(snapshot_.size());
}

void StepServer::takeChunk() {
  if (request_.blob_offset == 0) incoming_.clear();
  const auto size = static_cast<std::size_t>(std::max(request_.blob_size, 0));
  const auto offset = static_cast<std::size_t>(request_.blob_offset);
  if (size > kMaxStateBytes || incoming_.size() != offset ||
      incoming_.size() + request_.chunk.size() > size) {
    throw std::logic_error(fmt::format(
        "restore: {} bytes at {} of {} do not continue the {} that came", request_.chunk_size,
        request_.blob_offset, request_.blob_size, incoming_.size()));
  }
  incoming_.insert(incoming_.end(), request_.chunk.begin(), request_.chunk.end());
  if (incoming_.size() == size) participant_.restoreState(incoming_);
}

void StepServer::fillReply(const Header& header, std::int8_t status, const std::string& text) {
  reply_.header = header;
  reply_.header.protocol_version = kProtocolVersion;
  reply_.server = static_cast<std::int64_t>(server_id_);
  reply_.status = status;
  reply_.text.assign(text, 0, kMaxTextBytes);
  reply_.time_ns = toNs(participant_.time());
  const bool readable = status == Reply::OK && participant_.state() == LifecycleState::kStep;
  reply_.state_digest = readable ? static_cast<std::int64_t>(participant_.stateDigest()) : 0;
  toMessage(readable ? participant_.sensors() : SensorFrame{}, 0, reply_.sensors);
  const bool with_truth = readable && reply_.chunk.empty();
  const std::optional<TruthFrame> truth = with_truth ? participant_.truth() : std::nullopt;
  reply_.truth_count = truth ? 1 : 0;
  reply_.truth.resize(truth ? 1 : 0);
  if (truth) toMessage(*truth, 0, reply_.truth[0]);
  reply_.added = readable ? participant_.added(AddedTo::kSensors).values : std::vector<double>();
  reply_.added_count = static_cast<std::int32_t>(reply_.added.size());
  reply_.truth_added = truth ? participant_.added(AddedTo::kTruth).values : std::vector<double>();
  reply_.truth_added_count = static_cast<std::int32_t>(reply_.truth_added.size());
}

const Bytes* StepServer::answerOutside(const Header& header, std::int8_t status,
                                       const std::string& text) {
  Reply answer{};
  answer.header = header;
  answer.header.protocol_version = kProtocolVersion;
  answer.server = static_cast<std::int64_t>(server_id_);
  answer.status = status;
  answer.text.assign(text, 0, kMaxTextBytes);
  answer.time_ns = toNs(participant_.time());
  encodeMessage(answer, outside_reply_);
  return &outside_reply_;
}

const Bytes* StepServer::stillWorking(const std::string& doing) {
  return answerOutside(request_.header, Reply::BUSY,
                       fmt::format("{}: {}", participant_.name(), doing));
}

bool StepServer::retired(std::int64_t session) const {
  return std::find(retired_.begin(), retired_.end(), session) != retired_.end();
}

void StepServer::drop() {
  if (session_id_ != 0) retired_.push_back(session_id_);
  session_ = Session::kNone;
  session_id_ = sequence_ = 0;
  snapshot_.clear();
  incoming_.clear();
}

}  // namespace ballbot
