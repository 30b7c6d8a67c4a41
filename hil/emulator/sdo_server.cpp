#include "hil/emulator/sdo_server.hpp"

#include <cstring>
#include <utility>

namespace ballbot {
namespace {

using namespace sdo_abort;

// Command bytes: client command specifier in bits 7 to 5 (CiA 301, 7.2.4.3).
enum Request : std::uint8_t {
  kSegmentDownload = 0,
  kInitiateDownload = 1,
  kInitiateUpload = 2,
  kSegmentUpload = 3,
  kAbortTransfer = 4,
};
constexpr std::uint8_t kToggleBit = 0x10;

}  // namespace

SdoServer::SdoServer(ObjectDictionary& dictionary, Veto veto, Refresh refresh)
    : dictionary_(dictionary), veto_(std::move(veto)), refresh_(std::move(refresh)) {}

bool SdoServer::answer(const std::uint8_t q[8], std::uint8_t r[8]) {
  std::memset(r, 0, 8);
  const std::uint8_t specifier = q[0] >> 5;
  if (specifier == kInitiateDownload || specifier == kInitiateUpload) {
    index_ = static_cast<std::uint16_t>(q[1] + 256 * q[2]);
    sub_ = q[3];
    transfer_ = Transfer::kNone;
  }
  switch (specifier) {
    case kInitiateDownload:
      startDownload(q, r);
      return true;
    case kSegmentDownload:
      downloadSegment(q, r);
      return true;
    case kInitiateUpload:
      startUpload(r);
      return true;
    case kSegmentUpload:
      uploadSegment(q, r);
      return true;
    case kAbortTransfer:
      transfer_ = Transfer::kNone;
      return false;
    default:
      index_ = static_cast<std::uint16_t>(q[1] + 256 * q[2]);
      sub_ = q[3];
      refuse(kCommand, r);
      return true;
  }
}

void SdoServer::refuse(std::uint32_t code, std::uint8_t* r) {
  transfer_ = Transfer::kNone;
  r[0] = 0x80;
  r[1] = static_cast<std::uint8_t>(index_ & 0xFF);
  r[2] = static_cast<std::uint8_t>(index_ >> 8);
  r[3] = sub_;
  for (int i = 0; i < 4; ++i) r[4 + i] = static_cast<std::uint8_t>(code >> (8 * i) & 0xFF);
}

std::uint32_t SdoServer::lookUp(OdEntry*& entry) {
  if (!dictionary_.hasIndex(index_)) return kNoObject;
  entry = dictionary_.find(index_, sub_);
  return entry == nullptr ? kNoSub : kNone;
}

std::uint32_t SdoServer::store(const std::string& bytes) {
  OdEntry* entry = nullptr;
  if (const std::uint32_t code = lookUp(entry)) return code;
  if (!entry->writable()) return kReadOnly;
  if (static_cast<int>(bytes.size()) != sizeOf(entry->type)) return kLength;
  std::uint64_t raw = 0;
  for (std::size_t i = bytes.size(); i-- > 0;)
    raw = raw * 256 + static_cast<std::uint8_t>(bytes[i]);
  const int bits = 8 * static_cast<int>(bytes.size());
  auto value = static_cast<std::int64_t>(raw);
  if (isSigned(entry->type) && (raw >> (bits - 1)) != 0) value -= std::int64_t{1} << bits;
  if (entry->high && value > *entry->high) return kTooHigh;
  if (entry->low && value < *entry->low) return kTooLow;
  if (const std::uint32_t code = veto_(index_, sub_, value)) return code;
  entry->value = value;
  return kNone;
}

void SdoServer::startDownload(const std::uint8_t* q, std::uint8_t* r) {
  OdEntry* entry = nullptr;
  std::uint32_t code = lookUp(entry);
  if (code == kNone && !entry->writable()) code = kReadOnly;
  const bool expedited = (q[0] & 0x02) != 0;
  size_known_ = (q[0] & 0x01) != 0;
  if (code == kNone && expedited) {
    // Without a size the server takes as much as the object has.
    const int size = size_known_ ? 4 - (q[0] >> 2 & 3) : sizeOf(entry->type);
    code = size > 4 ? kLength
                    : store(std::string(reinterpret_cast<const char*>(q + 4),
                                        static_cast<std::size_t>(size)));
  } else if (code == kNone) {
    announced_ = static_cast<std::size_t>(q[4]) + (static_cast<std::size_t>(q[5]) << 8) +
                 (static_cast<std::size_t>(q[6]) << 16) + (static_cast<std::size_t>(q[7]) << 24);
    if (size_known_ && announced_ != static_cast<std::size_t>(sizeOf(entry->type))) code = kLength;
    transfer_ = Transfer::kDownload;
    buffer_.clear();
    toggle_ = 0;
  }
  if (code != kNone) return refuse(code, r);
  r[0] = 0x60;
  r[1] = q[1];
  r[2] = q[2];
  r[3] = q[3];
}

void SdoServer::downloadSegment(const std::uint8_t* q, std::uint8_t* r) {
  if (transfer_ != Transfer::kDownload) return refuse(kCommand, r);
  if ((q[0] & kToggleBit) != toggle_) return refuse(kToggle, r);
  const std::size_t count = 7 - (q[0] >> 1 & 7);
  buffer_.append(reinterpret_cast<const char*>(q + 1), count);
  const OdEntry* entry = dictionary_.find(index_, sub_);
  if (buffer_.size() > static_cast<std::size_t>(sizeOf(entry->type))) return refuse(kLength, r);
  if ((q[0] & 0x01) != 0) {
    if (const std::uint32_t code = store(buffer_)) return refuse(code, r);
    transfer_ = Transfer::kNone;
  }
  r[0] = static_cast<std::uint8_t>(0x20 | toggle_);
  toggle_ ^= kToggleBit;
}

void SdoServer::startUpload(std::uint8_t* r) {
  refresh_();
  OdEntry* entry = nullptr;
  if (const std::uint32_t code = lookUp(entry)) return refuse(code, r);
  if (!entry->readable()) return refuse(kWriteOnly, r);
  r[1] = static_cast<std::uint8_t>(index_ & 0xFF);
  r[2] = static_cast<std::uint8_t>(index_ >> 8);
  r[3] = sub_;
  if (entry->type != OdType::kText) {
    const int size = sizeOf(entry->type);
    r[0] = static_cast<std::uint8_t>(0x43 | (4 - size) << 2);
    for (int i = 0; i < size; ++i)
      r[4 + i] = static_cast<std::uint8_t>(entry->value >> (8 * i) & 0xFF);
    return;
  }
  buffer_ = entry->text;
  if (!buffer_.empty() && buffer_.size() <= 4) {
    r[0] = static_cast<std::uint8_t>(0x43 | (4 - buffer_.size()) << 2);
    std::memcpy(r + 4, buffer_.data(), buffer_.size());
    return;
  }
  r[0] = 0x41;
  for (int i = 0; i < 4; ++i)
    r[4 + i] = static_cast<std::uint8_t>(buffer_.size() >> (8 * i) & 0xFF);
  transfer_ = Transfer::kUpload;
  position_ = 0;
  toggle_ = 0;
}

void SdoServer::uploadSegment(const std::uint8_t* q, std::uint8_t* r) {
  if (transfer_ != Transfer::kUpload) return refuse(kCommand, r);
  if ((q[0] & kToggleBit) != toggle_) return refuse(kToggle, r);
  const std::size_t left = buffer_.size() - position_;
  const std::size_t count = left < 7 ? left : 7;
  const bool last = count == left;
  r[0] = static_cast<std::uint8_t>(toggle_ | (7 - count) << 1 | (last ? 1 : 0));
  std::memcpy(r + 1, buffer_.data() + position_, count);
  position_ += count;
  toggle_ ^= kToggleBit;
  if (last) transfer_ = Transfer::kNone;
}

}  // namespace ballbot
