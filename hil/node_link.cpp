#include "hil/node_link.hpp"

#include <utility>

#include <fmt/format.h>

namespace ballbot {

NodeLink::NodeLink(int node, std::vector<SetupStep> setup, int sdo_timeout_cycles,
                   int heartbeat_cycles)
    : node_(node),
      setup_(std::move(setup)),
      sdo_(node, sdo_timeout_cycles),
      heartbeat_cycles_(heartbeat_cycles) {}

void NodeLink::expectBootUp(int patience_cycles) noexcept {
  phase_ = Phase::kBooting;
  trouble_ = NodeTrouble::kNone;
  waited_ = 0;
  patience_ = patience_cycles;
  step_ = 0;
  seen_operational_ = asking_ = false;
}

void NodeLink::start() noexcept {
  phase_ = Phase::kRunning;
  waited_ = 0;
}

void NodeLink::fail(NodeTrouble trouble) noexcept {
  if (trouble_ == NodeTrouble::kNone) trouble_ = trouble;
}

bool NodeLink::awaitsAnswer() const noexcept {
  if (trouble_ != NodeTrouble::kNone) return false;
  return phase_ == Phase::kBooting || phase_ == Phase::kConfiguring;
}

bool NodeLink::onFrame(const CanFrame& frame, FrameQueue& out) noexcept {
  if (const auto beat = readHeartbeat(frame); beat && beat->node == node_) {
    if (phase_ == Phase::kBooting && beat->state == NmtState::kBootUp) {
      phase_ = Phase::kConfiguring;
      nextStep(out);
      return true;
    }
    if (phase_ != Phase::kRunning) {
      if (beat->state == NmtState::kBootUp && phase_ != Phase::kIdle) fail(NodeTrouble::kReboot);
      return true;
    }
    waited_ = 0;
    if (beat->state == NmtState::kOperational) {
      seen_operational_ = true;
    } else if (beat->state == NmtState::kBootUp) {
      fail(NodeTrouble::kReboot);
    } else if (seen_operational_) {
      if (trouble_ == NodeTrouble::kNone) left_for_ = beat->state;
      fail(NodeTrouble::kLeftOperational);
    }
    return true;
  }
  if (const auto emergency = readEmergency(frame); emergency && emergency->node == node_) {
    // Code 0 says that an error is over. It changes nothing: what has stopped stays stopped.
    if (emergency->code != 0 && trouble_ == NodeTrouble::kNone) {
      emergency_ = *emergency;
      fail(NodeTrouble::kEmergency);
    }
    return true;
  }
  if (!sdo_.onFrame(frame, out)) return false;
  if (phase_ == Phase::kConfiguring) onTransfer(out);
  return true;
}

void NodeLink::nextStep(FrameQueue& out) noexcept {
  if (step_ == setup_.size()) {
    phase_ = Phase::kConfigured;
    return;
  }
  const SetupStep& step = setup_[step_];
  reading_ = step.kind != SetupStep::Kind::kWrite;
  if (reading_) return sdo_.upload(step.object, out);
  std::uint8_t bytes[8];
  putLittleEndian(bytes, static_cast<std::uint64_t>(step.value), sizeof bytes);
  sdo_.download(step.object, bytes, step.size, out);
}

void NodeLink::onTransfer(FrameQueue& out) noexcept {
  if (sdo_.status() == SdoClient::Status::kBusy || trouble_ != NodeTrouble::kNone) return;
  if (sdo_.status() != SdoClient::Status::kDone) return fail(NodeTrouble::kSetupRefused);
  const SetupStep& step = setup_[step_];
  if (!reading_) {
    reading_ = true;
    return sdo_.upload(step.check, out);
  }
  const std::size_t size = sdo_.size() < 8 ? sdo_.size() : 8;
  const bool negative = step.value < 0;
  found_ = negative ? getSigned(sdo_.data(), size)
                    : static_cast<std::int64_t>(getLittleEndian(sdo_.data(), size));
  bool good = found_ == step.value;
  if (step.kind == SetupStep::Kind::kExpectBits) good = (found_ & step.value) == step.value;
  if (step.kind == SetupStep::Kind::kAtLeast) good = found_ >= step.value;
  if (!good) return fail(NodeTrouble::kSetupRefused);
  ++step_;
  nextStep(out);
}

void NodeLink::onCycle(FrameQueue& out) noexcept {
  sdo_.onTick(out);
  if (phase_ == Phase::kConfiguring) onTransfer(out);
  ++waited_;
  if (phase_ == Phase::kBooting && waited_ > patience_) fail(NodeTrouble::kNoBootUp);
  if (phase_ == Phase::kRunning && waited_ > heartbeat_cycles_) fail(NodeTrouble::kHeartbeatLost);
}

bool NodeLink::ask(ObjectAddress object, bool urgent, FrameQueue& out) noexcept {
  if (phase_ != Phase::kRunning) return false;
  if (asking_ && (!urgent || sdo_.object() == object)) return false;
  asking_ = true;
  sdo_.upload(object, out);
  return true;
}

void NodeLink::tell(ObjectAddress object, std::uint64_t value, std::size_t size,
                    FrameQueue& out) noexcept {
  if (phase_ != Phase::kRunning) return;
  asking_ = true;
  std::uint8_t bytes[8];
  putLittleEndian(bytes, value, sizeof bytes);
  sdo_.download(object, bytes, size, out);
}

std::optional<NodeLink::Answer> NodeLink::takeAnswer() noexcept {
  if (!asking_ || sdo_.status() == SdoClient::Status::kBusy) return std::nullopt;
  asking_ = false;
  Answer answer{sdo_.object(), sdo_.status() == SdoClient::Status::kDone, 0};
  if (answer.given) {
    answer.value = getLittleEndian(sdo_.data(), sdo_.size() < 8 ? sdo_.size() : 8);
  }
  return answer;
}

std::string NodeLink::progressText() const {
  if (phase_ == Phase::kBooting) return fmt::format("node {}: waiting for its boot-up", node_);
  if (step_ == setup_.size()) return "";
  const SetupStep& step = setup_[step_];
  return fmt::format("node {}: {} of {}, {} {}", node_, step_, setup_.size(), toText(step.object),
                     step.what);
}

std::string NodeLink::troubleText() const {
  switch (trouble_) {
    case NodeTrouble::kNone:
      return "";
    case NodeTrouble::kNoBootUp:
      return fmt::format("node {} does not answer a reset. Is it powered, and is its node-ID {}?",
                         node_, node_);
    case NodeTrouble::kReboot:
      return fmt::format("node {} has started anew by itself", node_);
    case NodeTrouble::kLeftOperational:
      return fmt::format("node {} left operational by itself: it said that it is {}", node_,
                         toText(left_for_));
    case NodeTrouble::kHeartbeatLost:
      return fmt::format("node {}: no heartbeat for {} cycles", node_, heartbeat_cycles_);
    case NodeTrouble::kEmergency:
      return fmt::format("node {}: emergency {:04X} ({}), error register {:02X}", node_,
                         emergency_.code, errorCodeText(emergency_.code),
                         emergency_.error_register);
    case NodeTrouble::kSetupRefused:
      break;
  }
  const SetupStep& step = setup_[step_];
  if (sdo_.status() == SdoClient::Status::kDone) {
    const char* relation = step.kind == SetupStep::Kind::kExpectBits ? "must have the bits"
                           : step.kind == SetupStep::Kind::kAtLeast  ? "must be at least"
                                                                     : "configured";
    return fmt::format("node {}: {} {} is {} ({:#x}), {} {} ({:#x})", node_, toText(step.check),
                       step.what, found_, found_, relation, step.value, step.value);
  }
  return fmt::format("node {}: {} {}: {} refused, {:08X} ({})", node_, toText(step.object),
                     step.what, reading_ ? "reading" : "writing", sdo_.abortCode(),
                     sdoAbortText(sdo_.abortCode()));
}

}  // namespace ballbot
