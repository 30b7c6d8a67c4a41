#include "tools/standing_output.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "core/error.hpp"
#include "tools/interrupt.hpp"

namespace ballbot {
namespace {

constexpr int kLookAgain_ms = 100;

const char* requestFor(Posture posture) {
  switch (posture) {
    case Posture::kBlocked:
      return "Block the output of {}, so that it cannot turn.";
    case Posture::kFree:
      return "Free the output of {}: it will swing about by itself. Keep clear of it.";
    case Posture::kBackDriven:
      return "Take the output of {} in your hand. It stays still until you press Enter; then it\n"
             "pushes and pulls gently for 20 s: turn it to and fro against that, slowly and fast,\n"
             "and begin once you feel it.";
  }
  return "";
}

void waitForEnter() {
  fmt::print(stderr, "Enter goes on, Ctrl-C ends: ");
  pollfd in{STDIN_FILENO, POLLIN, 0};
  char c = 0;
  while (c != '\n') {
    if (interruptFlag()->load()) {
      throw InterruptedError("identify: interrupted; no drive is switched on");
    }
    if (::poll(&in, 1, kLookAgain_ms) <= 0) continue;
    if (::read(STDIN_FILENO, &c, 1) <= 0) throw InputError("identify: nobody pressed Enter");
  }
}

}  // namespace

void bringInto(Posture posture, SdoExchange& drive, const std::string& drive_name) {
  if (hasStand(drive)) return setStand(drive, posture);
  const bool terminal = ::isatty(STDIN_FILENO) == 1;
  if (!terminal && posture != Posture::kBlocked) {
    throw InputError(fmt::format(
        "identify: the output of {} must be {} now, and there is no terminal to ask a person at. "
        "Start it in one, or with --response-only",
        drive_name, toText(posture)));
  }
  fmt::print(stderr, "identify: {}\n", fmt::format(fmt::runtime(requestFor(posture)), drive_name));
  if (terminal) waitForEnter();
}

}  // namespace ballbot
