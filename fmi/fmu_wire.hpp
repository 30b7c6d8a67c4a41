#pragma once

#include <chrono>
#include <string>

#include "core/state_blob.hpp"

namespace ballbot {

// The talk between FmuProcess and its child: each message is a length of 8 bytes and a sealed blob.

enum class FmuRequest : std::uint8_t {
  kOpen,
  kInitialize,
  kEvaluate,
  kStep,
  kTerminate,
  kReset,
  kSave,
  kRestore
};
enum class FmuReply : std::uint8_t { kOk, kInputError, kNumericalError, kOutputError };

constexpr const char* kFmuRequestKind = "fmu request";
constexpr const char* kFmuReplyKind = "fmu reply";
constexpr std::uint32_t kFmuWireVersion = 1;

void putRequest(BlobWriter& out, FmuRequest kind);
void putText(BlobWriter& out, const std::string& text);
std::string getText(BlobReader& in);

enum class WireEnd { kOk, kClosed, kTimeout };
WireEnd sendBlob(int socket, const StateBlob& blob);
/// Waits for ever if `patience` is zero.
WireEnd receiveBlob(int socket, StateBlob& blob, std::chrono::milliseconds patience);

/// Reads until the other end is closed by all who hold it, or patience is over.
void awaitEndOfStream(int socket, std::chrono::milliseconds patience);

}  // namespace ballbot
