#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "hil/frame_queue.hpp"

namespace ballbot {

/// Object of a node's dictionary.
struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
};
constexpr bool operator==(ObjectAddress a, ObjectAddress b) noexcept {
  return a.index == b.index && a.sub == b.sub;
}
/// "6071:00"
std::string toText(ObjectAddress object);

/// Abort codes the client itself sends.
constexpr std::uint32_t kSdoToggleError = 0x05030000, kSdoTimeout = 0x05040000,
                        kSdoBadCommand = 0x05040001, kSdoOutOfMemory = 0x05040005;
/// What an abort code says, in words; "" if it is not in CiA 301.
const char* sdoAbortText(std::uint32_t code) noexcept;

/// One SDO transfer at a time with one node (CiA 301, 7.2.4): upload and download, expedited up to
/// four bytes and segmented above. No clock: whoever owns it says when a tick has passed.
class SdoClient {
 public:
  static constexpr std::size_t kMaxBytes = 128;  ///< of an object: names are the longest ones here
  enum class Status { kIdle, kBusy, kDone, kAborted, kTimedOut };

  /// @param timeout_ticks silence of the server after which a transfer is given up
  SdoClient(int node, int timeout_ticks) : node_(node), timeout_ticks_(timeout_ticks) {}

  /// Begins a transfer; one under way is forgotten.
  void upload(ObjectAddress object, FrameQueue& out) noexcept;
  /// @param size 1 to kMaxBytes
  void download(ObjectAddress object, const std::uint8_t* data, std::size_t size,
                FrameQueue& out) noexcept;
  /// True if the frame is from this node's SDO server.
  bool onFrame(const CanFrame& frame, FrameQueue& out) noexcept;
  void onTick(FrameQueue& out) noexcept;

  Status status() const noexcept { return status_; }
  ObjectAddress object() const noexcept { return object_; }
  /// Of the last upload.
  const std::uint8_t* data() const noexcept { return data_.data(); }
  std::size_t size() const noexcept { return size_; }
  std::uint32_t abortCode() const noexcept { return abort_code_; }

 private:
  enum class Phase { kNone, kUploadStart, kUploadSegment, kDownloadStart, kDownloadSegment };

  void begin(ObjectAddress object, Phase phase) noexcept;
  CanFrame request(std::uint8_t command) const noexcept;
  CanFrame segmentRequest(std::uint8_t command) const noexcept;
  void abort(std::uint32_t code, FrameQueue& out) noexcept;
  void finish(Status status) noexcept;
  void onUploadStart(const CanFrame& frame, FrameQueue& out) noexcept;
  void onUploadSegment(const CanFrame& frame, FrameQueue& out) noexcept;
  void onDownloadSegment(const CanFrame& frame, FrameQueue& out) noexcept;
  void sendSegment(FrameQueue& out) noexcept;
  bool answersRequest(const CanFrame& frame) const noexcept;
  bool fits(int answer) const noexcept;

  int node_, timeout_ticks_;
  int silent_ticks_ = 0;
  Status status_ = Status::kIdle;
  Phase phase_ = Phase::kNone;
  ObjectAddress object_;
  std::array<std::uint8_t, kMaxBytes> data_{};
  std::size_t size_ = 0, position_ = 0;
  std::size_t announced_ = 0;  ///< size the server has told, 0 if none
  bool toggle_ = false;
  std::uint32_t abort_code_ = 0;
  CanFrame taken_;  ///< the last answer that was acted on
};

}  // namespace ballbot
