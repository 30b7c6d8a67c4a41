#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "hil/can_frame.hpp"
#include "hil/emulator/object_dictionary.hpp"

namespace ballbot {

/// Abort codes of CiA 301 that the emulated nodes give; 0 is success.
namespace sdo_abort {
constexpr std::uint32_t kNone = 0, kToggle = 0x05030000, kCommand = 0x05040001,
                        kUnsupported = 0x06010000, kWriteOnly = 0x06010001, kReadOnly = 0x06010002,
                        kNoObject = 0x06020000, kNotMappable = 0x06040041, kPdoLength = 0x06040042,
                        kIncompatible = 0x06040043, kLength = 0x06070010, kNoSub = 0x06090011,
                        kValue = 0x06090030, kTooHigh = 0x06090031, kTooLow = 0x06090032,
                        kDeviceState = 0x08000022;
}

/// The SDO server of an emulated node: expedited and segmented transfer in both directions. Block
/// transfer is refused as an unknown command, which CiA 301 leaves to the server.
class SdoServer {
 public:
  /// Decides on a value before it is stored; gives an abort code.
  using Veto =
      std::function<std::uint32_t(std::uint16_t index, std::uint8_t sub, std::int64_t value)>;
  /// Called before an object is read, so that it is up to date.
  using Refresh = std::function<void()>;

  SdoServer(ObjectDictionary& dictionary, Veto veto, Refresh refresh);

  /// Answers one request of 8 bytes; false if it deserves no answer (a client's abort).
  bool answer(const std::uint8_t request[8], std::uint8_t response[8]);
  /// Forgets a transfer under way.
  void reset() { transfer_ = Transfer::kNone; }

 private:
  enum class Transfer { kNone, kUpload, kDownload };

  void startDownload(const std::uint8_t* q, std::uint8_t* r);
  void downloadSegment(const std::uint8_t* q, std::uint8_t* r);
  void startUpload(std::uint8_t* r);
  void uploadSegment(const std::uint8_t* q, std::uint8_t* r);
  void refuse(std::uint32_t code, std::uint8_t* r);
  std::uint32_t lookUp(OdEntry*& entry);
  std::uint32_t store(const std::string& bytes);

  ObjectDictionary& dictionary_;
  Veto veto_;
  Refresh refresh_;
  Transfer transfer_ = Transfer::kNone;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  std::string buffer_;
  std::size_t position_ = 0, announced_ = 0;
  bool size_known_ = false;
  std::uint8_t toggle_ = 0;
};

}  // namespace ballbot
