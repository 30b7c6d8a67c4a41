#include "fmi/fmu_wire.hpp"

#include <cerrno>

#include <poll.h>
#include <sys/socket.h>

namespace ballbot {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kLongestMessage = std::uint64_t{1} << 30;

WireEnd receiveBytes(int socket, void* to, std::size_t size, Clock::time_point until,
                     bool for_ever) {
  auto* at = static_cast<std::uint8_t*>(to);
  while (size > 0) {
    int wait = -1;
    if (!for_ever) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      if (left <= 0) return WireEnd::kTimeout;
      wait = static_cast<int>(left);
    }
    pollfd ready{socket, POLLIN, 0};
    if (::poll(&ready, 1, wait) < 0 && errno != EINTR) return WireEnd::kClosed;
    const ssize_t got = ::recv(socket, at, size, MSG_DONTWAIT);
    if (got == 0) return WireEnd::kClosed;
    if (got < 0) {
      if (errno == EAGAIN || errno == EINTR) continue;
      return WireEnd::kClosed;
    }
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return WireEnd::kOk;
}

WireEnd sendBytes(int socket, const void* from, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(from);
  while (size > 0) {
    const ssize_t sent = ::send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0) {
      if (errno == EINTR) continue;
      return WireEnd::kClosed;
    }
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return WireEnd::kOk;
}

}  // namespace

void putRequest(BlobWriter& out, FmuRequest kind) { out.put(kind); }

void putText(BlobWriter& out, const std::string& text) {
  out.putBlob(StateBlob(text.begin(), text.end()));
}

std::string getText(BlobReader& in) {
  const StateBlob bytes = in.getBlob();
  return {bytes.begin(), bytes.end()};
}

WireEnd sendBlob(int socket, const StateBlob& blob) {
  StateBlob message(sizeof(std::uint64_t) + blob.size());
  const std::uint64_t size = blob.size();
  std::memcpy(message.data(), &size, sizeof size);
  std::memcpy(message.data() + sizeof size, blob.data(), blob.size());
  return sendBytes(socket, message.data(), message.size());
}

WireEnd receiveBlob(int socket, StateBlob& blob, std::chrono::milliseconds patience) {
  const bool for_ever = patience.count() == 0;
  const Clock::time_point until = Clock::now() + patience;
  std::uint64_t size = 0;
  const WireEnd head = receiveBytes(socket, &size, sizeof size, until, for_ever);
  if (head != WireEnd::kOk) return head;
  if (size > kLongestMessage) return WireEnd::kClosed;  // not from us
  blob.resize(size);
  return receiveBytes(socket, blob.data(), blob.size(), until, for_ever);
}

void awaitEndOfStream(int socket, std::chrono::milliseconds patience) {
  const Clock::time_point until = Clock::now() + patience;
  std::uint8_t unwanted = 0;
  while (receiveBytes(socket, &unwanted, 1, until, false) == WireEnd::kOk) {
  }
}

}  // namespace ballbot
