#include "hil/sdo_client.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hil/canopen_codec.hpp"

namespace ballbot {
namespace {

// First bytes of the client's requests; the server's answers are told apart by their top 3 bits.
constexpr std::uint8_t kUpload = 0x40, kUploadSegment = 0x60, kDownloadSized = 0x21, kAbort = 0x80;
constexpr std::uint8_t kToggle = 0x10;
constexpr std::size_t kExpedited = 4, kPerSegment = 7;

constexpr int specifier(std::uint8_t command) { return command >> 5; }
constexpr int kScsUploadSegment = 0, kScsDownloadSegment = 1, kScsUpload = 2, kScsDownload = 3,
              kScsAbort = 4;

}  // namespace

std::string toText(ObjectAddress object) {
  return fmt::format("{:04X}:{:02X}", object.index, object.sub);
}

const char* sdoAbortText(std::uint32_t code) noexcept {
  switch (code) {
    case 0x05030000:
      return "toggle bit not alternated";
    case 0x05040000:
      return "SDO protocol timed out";
    case 0x05040001:
      return "unknown command";
    case 0x05040005:
      return "out of memory";
    case 0x06010000:
      return "unsupported access";
    case 0x06010001:
      return "write only";
    case 0x06010002:
      return "read only";
    case 0x06020000:
      return "no such object";
    case 0x06040041:
      return "object cannot be mapped to a PDO";
    case 0x06040042:
      return "mapped objects exceed the length of a PDO";
    case 0x06040043:
      return "parameters are incompatible";
    case 0x06060000:
      return "hardware error";
    case 0x06070010:
      return "length does not match";
    case 0x06070012:
      return "too long";
    case 0x06070013:
      return "too short";
    case 0x06090011:
      return "no such sub-index";
    case 0x06090030:
      return "value not allowed";
    case 0x06090031:
      return "value too high";
    case 0x06090032:
      return "value too low";
    case 0x08000000:
      return "general error";
    case 0x08000020:
      return "cannot be stored";
    case 0x08000022:
      return "not in this device state";
    default:
      return "";
  }
}

void SdoClient::begin(ObjectAddress object, Phase phase) noexcept {
  object_ = object;
  phase_ = phase;
  status_ = Status::kBusy;
  silent_ticks_ = 0;
  position_ = announced_ = 0;
  toggle_ = false;
  abort_code_ = 0;
}

void SdoClient::finish(Status status) noexcept {
  status_ = status;
  phase_ = Phase::kNone;
}

CanFrame SdoClient::request(std::uint8_t command) const noexcept {
  CanFrame frame;
  frame.id = kCobSdoToServer + static_cast<std::uint32_t>(node_);
  frame.size = 8;
  frame.data[0] = command;
  putLittleEndian(&frame.data[1], object_.index, 2);
  frame.data[3] = object_.sub;
  return frame;
}

CanFrame SdoClient::segmentRequest(std::uint8_t command) const noexcept {
  CanFrame frame = request(command);
  std::fill(frame.data.begin() + 1, frame.data.begin() + 8, std::uint8_t{0});
  return frame;
}

void SdoClient::abort(std::uint32_t code, FrameQueue& out) noexcept {
  CanFrame frame = request(kAbort);
  putLittleEndian(&frame.data[4], code, 4);
  out.push(frame);
  abort_code_ = code;
  finish(Status::kAborted);
}

void SdoClient::upload(ObjectAddress object, FrameQueue& out) noexcept {
  begin(object, Phase::kUploadStart);
  size_ = 0;
  out.push(request(kUpload));
}

void SdoClient::download(ObjectAddress object, const std::uint8_t* data, std::size_t size,
                         FrameQueue& out) noexcept {
  begin(object, Phase::kDownloadStart);
  size_ = std::min(size, kMaxBytes);
  std::copy(data, data + size_, data_.begin());
  CanFrame frame;
  if (size_ <= kExpedited) {
    // 2F, 2B, 27, 23 for 1 to 4 bytes: expedited, size indicated.
    frame = request(static_cast<std::uint8_t>(0x23 | (kExpedited - size_) << 2));
    std::copy(data, data + size_, frame.data.begin() + 4);
  } else {
    frame = request(kDownloadSized);
    putLittleEndian(&frame.data[4], size_, 4);
  }
  out.push(frame);
}

bool SdoClient::answersRequest(const CanFrame& frame) const noexcept {
  return getLittleEndian(&frame.data[1], 2) == object_.index && frame.data[3] == object_.sub;
}

bool SdoClient::onFrame(const CanFrame& frame, FrameQueue& out) noexcept {
  if (frame.extended || frame.remote || frame.size != 8) return false;
  if (frame.id != kCobSdoToClient + static_cast<std::uint32_t>(node_)) return false;
  if (status_ != Status::kBusy) return true;  // nobody waits for it
  const int answer = specifier(frame.data[0]);
  const bool initiates = answer == kScsUpload || answer == kScsDownload;
  if (initiates && !answersRequest(frame)) return true;  // of an earlier transfer
  if (answer == kScsAbort) {
    if (!answersRequest(frame)) return true;  // of an earlier transfer
    abort_code_ = static_cast<std::uint32_t>(getLittleEndian(&frame.data[4], 4));
    finish(Status::kAborted);
    return true;
  }
  // Some adapters show a frame twice. A copy is recognised where it does not fit; where it fits it
  // says what the first one said.
  const bool copy = frame == taken_;
  const bool segment = phase_ == Phase::kUploadSegment || phase_ == Phase::kDownloadSegment;
  const bool wrong_toggle = segment && ((frame.data[0] & kToggle) != 0) != toggle_;
  if (copy && (!fits(answer) || wrong_toggle)) return true;
  if (!fits(answer)) {
    abort(kSdoBadCommand, out);
    return true;
  }
  taken_ = frame;
  silent_ticks_ = 0;
  switch (phase_) {
    case Phase::kUploadStart:
      onUploadStart(frame, out);
      break;
    case Phase::kUploadSegment:
      onUploadSegment(frame, out);
      break;
    case Phase::kDownloadStart:
      if (size_ <= kExpedited) {
        finish(Status::kDone);
      } else {
        phase_ = Phase::kDownloadSegment;
        sendSegment(out);
      }
      break;
    case Phase::kDownloadSegment:
      onDownloadSegment(frame, out);
      break;
    case Phase::kNone:
      break;
  }
  return true;
}

// Whether the answer is of the kind that the transfer waits for.
bool SdoClient::fits(int answer) const noexcept {
  switch (phase_) {
    case Phase::kUploadStart:
      return answer == kScsUpload;
    case Phase::kUploadSegment:
      return answer == kScsUploadSegment;
    case Phase::kDownloadStart:
      return answer == kScsDownload;
    case Phase::kDownloadSegment:
      return answer == kScsDownloadSegment;
    case Phase::kNone:
      return false;
  }
  return false;
}

void SdoClient::onUploadStart(const CanFrame& frame, FrameQueue& out) noexcept {
  const std::uint8_t command = frame.data[0];
  const bool expedited = (command & 2U) != 0, sized = (command & 1U) != 0;
  if (expedited) {
    size_ = sized ? kExpedited - (command >> 2 & 3U) : kExpedited;
    std::copy(frame.data.begin() + 4, frame.data.begin() + 4 + static_cast<int>(size_),
              data_.begin());
    finish(Status::kDone);
    return;
  }
  announced_ = sized ? static_cast<std::size_t>(getLittleEndian(&frame.data[4], 4)) : 0;
  if (announced_ > kMaxBytes) return abort(kSdoOutOfMemory, out);
  phase_ = Phase::kUploadSegment;
  out.push(segmentRequest(kUploadSegment));
}

void SdoClient::onUploadSegment(const CanFrame& frame, FrameQueue& out) noexcept {
  const std::uint8_t command = frame.data[0];
  if (((command & kToggle) != 0) != toggle_) return abort(kSdoToggleError, out);
  const std::size_t count = kPerSegment - (command >> 1 & 7U);
  if (position_ + count > kMaxBytes) return abort(kSdoOutOfMemory, out);
  std::copy(frame.data.begin() + 1, frame.data.begin() + 1 + static_cast<int>(count),
            data_.begin() + static_cast<int>(position_));
  position_ += count;
  toggle_ = !toggle_;
  if ((command & 1U) == 0) {  // more to come
    out.push(segmentRequest(static_cast<std::uint8_t>(kUploadSegment | (toggle_ ? kToggle : 0))));
    return;
  }
  size_ = position_;
  if (announced_ != 0 && announced_ != size_) return abort(0x06070010, out);
  finish(Status::kDone);
}

void SdoClient::sendSegment(FrameQueue& out) noexcept {
  const std::size_t count = std::min(kPerSegment, size_ - position_);
  const bool last = position_ + count == size_;
  CanFrame frame = segmentRequest(static_cast<std::uint8_t>(
      (toggle_ ? kToggle : 0) | (kPerSegment - count) << 1 | (last ? 1 : 0)));
  std::copy(data_.begin() + static_cast<int>(position_),
            data_.begin() + static_cast<int>(position_ + count), frame.data.begin() + 1);
  position_ += count;
  out.push(frame);
}

void SdoClient::onDownloadSegment(const CanFrame& frame, FrameQueue& out) noexcept {
  if (((frame.data[0] & kToggle) != 0) != toggle_) return abort(kSdoToggleError, out);
  toggle_ = !toggle_;
  if (position_ == size_) {
    finish(Status::kDone);
  } else {
    sendSegment(out);
  }
}

void SdoClient::onTick(FrameQueue& out) noexcept {
  if (status_ != Status::kBusy || ++silent_ticks_ < timeout_ticks_) return;
  abort(kSdoTimeout, out);
  status_ = Status::kTimedOut;
}

}  // namespace ballbot
