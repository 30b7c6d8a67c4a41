#include "cosim/step_client.hpp"

#include <algorithm>

#include "core/printable_text.hpp"
#include "messages/convert.hpp"

namespace ballbot {

using Header = ballbot_msgs::step_header;

StepClient::StepClient(std::int64_t session, std::uint64_t config_digest)
    : session_(session), config_digest_(config_digest) {}

ballbot_msgs::step_request& StepClient::next(std::int8_t kind, SimTime time) {
  request_.header.protocol_version = kProtocolVersion;
  request_.header.session = session_;
  request_.header.sequence = ++sequence_;
  request_.header.kind = kind;
  request_.message_digest = messageDigest();
  request_.config_digest = static_cast<std::int64_t>(config_digest_);
  request_.time_ns = toNs(time);
  request_.step_ns = 0;
  request_.blob_size = request_.blob_offset = request_.chunk_size = 0;
  request_.chunk.clear();
  return request_;
}

const Bytes& StepClient::finish() {
  encodeMessage(request_, pending_);
  waiting_ = true;
  return pending_;
}

const Bytes& StepClient::hello(SimTime start) {
  toMessage(ActuatorCommand{}, 0, start, request_.command);
  next(Header::HELLO, start);
  return finish();
}

const Bytes& StepClient::step(SimTime now, SimDuration step, const ActuatorCommand& command) {
  next(Header::STEP, now).step_ns = toNs(step);
  toMessage(command, 0, now, request_.command);
  return finish();
}

const Bytes& StepClient::save(std::size_t offset) {
  next(Header::SAVE, SimTime{}).blob_offset = static_cast<std::int32_t>(offset);
  return finish();
}

const Bytes& StepClient::restore(const StateBlob& blob, std::size_t offset) {
  ballbot_msgs::step_request& request = next(Header::RESTORE, SimTime{});
  const std::size_t count = std::min(kChunkBytes, blob.size() - offset);
  request.blob_size = static_cast<std::int32_t>(blob.size());
  request.blob_offset = static_cast<std::int32_t>(offset);
  request.chunk_size = static_cast<std::int32_t>(count);
  request.chunk.assign(blob.data() + offset, blob.data() + offset + count);
  return finish();
}

const Bytes& StepClient::reset(SimTime start) {
  next(Header::RESET, start);
  return finish();
}

const Bytes& StepClient::bye() {
  next(Header::BYE, SimTime{});
  return finish();
}

const Bytes& StepClient::farewell() {
  next(Header::BYE, SimTime{});
  finish();
  waiting_ = false;
  return pending_;
}

const Bytes& StepClient::abort() {
  next(Header::ABORT, SimTime{});
  return finish();
}

StepClient::Received StepClient::receive(const std::uint8_t* data, std::size_t size) {
  Header header{};
  if (!decodeHeader(data, size, header)) {
    ++ignored_.damaged;
    return Received::kIgnored;
  }
  if (header.session != session_) {
    ++ignored_.foreign;
    return Received::kIgnored;
  }
  const bool expected = waiting_ && header.sequence == sequence_;
  if (fingerprint(data, size) != ballbot_msgs::step_reply::getHash() ||
      header.protocol_version != kProtocolVersion) {
    return expected ? Received::kOtherVersion : Received::kIgnored;
  }
  if (!decodeWhole(data, size, candidate_)) {
    ++ignored_.damaged;
    return Received::kIgnored;
  }
  if (server_ == 0) server_ = candidate_.server;
  if (candidate_.server != server_) return Received::kSecondServer;
  if (!expected) {
    ++ignored_.old;
    return Received::kIgnored;
  }
  if (candidate_.status == ballbot_msgs::step_reply::BUSY) {
    busy_text_ = printableText(candidate_.text);
    return Received::kBusy;
  }
  busy_text_.clear();
  std::swap(reply_, candidate_);
  reply_.text = printableText(reply_.text);
  waiting_ = false;
  return Received::kReply;
}

}  // namespace ballbot
