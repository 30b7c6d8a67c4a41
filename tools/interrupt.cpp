#include "tools/interrupt.hpp"

#include <csignal>

namespace ballbot {
namespace {

std::atomic<bool> interrupted{false}, absorbs{false};

extern "C" void onSignal(int number) {
  if (interrupted.exchange(true) && !absorbs.load()) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

}  // namespace

const std::atomic<bool>* interruptFlag(SecondSignal second) {
  if (second == SecondSignal::kIsAbsorbed) absorbs = true;
  struct sigaction action {};
  action.sa_handler = onSignal;  // without SA_RESTART, so that a waiting poll() wakes up
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return &interrupted;
}

}  // namespace ballbot
