#include "cosim/step_protocol.hpp"

namespace ballbot {

const char* requestName(std::int8_t kind) {
  using Header = ballbot_msgs::step_header;
  switch (kind) {
    case Header::HELLO:
      return "hello";
    case Header::STEP:
      return "step";
    case Header::SAVE:
      return "save";
    case Header::RESTORE:
      return "restore";
    case Header::RESET:
      return "reset";
    case Header::BYE:
      return "bye";
    case Header::ABORT:
      return "abort";
    case Header::PROBE:
      return "probe";
  }
  return "unknown request";
}

}  // namespace ballbot
