// Serves a spring on the LCM address given as URL and CHANNEL; writes one byte when it listens.
#include <cstdio>

#include <unistd.h>

#include "core/error.hpp"
#include "cosim/lcm_transport.hpp"
#include "cosim/serve.hpp"
#include "tests/cosim/support/spring_participant.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    ballbot::testing_support::SpringParticipant spring;
    ballbot::LcmTransport transport({argv[1], argv[2]}, ballbot::LinkEnd::kParticipant);
    if (::write(STDOUT_FILENO, "r", 1) != 1) return 2;
    ballbot::ServeOptions options;
    options.config_digest = 1;
    options.first_contact = std::chrono::seconds{10};
    options.idle_timeout = std::chrono::seconds{10};
    ballbot::serve(spring, transport, options);
    return 0;
  } catch (const ballbot::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.exitCode());
  }
}
