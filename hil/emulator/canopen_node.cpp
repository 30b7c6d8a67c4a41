#include "hil/emulator/canopen_node.hpp"

#include <algorithm>
#include <utility>

namespace ballbot {
namespace {

using namespace sdo_abort;

constexpr std::int64_t kMs = 1'000'000, kInhibitUnit = 100'000;
constexpr std::int64_t kInvalid = std::int64_t{1} << 31;
constexpr std::uint16_t kHeartbeatLost = 0x8130, kPdoTooShort = 0x8210, kPdoTooLong = 0x8220,
                        kSyncLength = 0x8240, kRpdoTimeout = 0x8250;
constexpr std::uint8_t kGenericError = 0x01, kCommunicationError = 0x10;
constexpr int kErrorHistory = 8;

void addCommonObjects(ObjectDictionary& d, int node, std::uint32_t device_type,
                      const std::string& name, std::uint32_t product) {
  using A = OdAccess;
  using T = OdType;
  d.variable(0x1000, "Device type", T::kU32, A::kConst, device_type);
  d.variable(0x1001, "Error register", T::kU8, A::kReadOnly, 0).mappable = true;
  d.structure(0x1003, "Pre-defined error field", OdShape::kArray);
  for (int i = 1; i <= kErrorHistory; ++i) {
    d.sub(0x1003, static_cast<std::uint8_t>(i), "Standard error field", T::kU32, A::kReadOnly, 0);
  }
  OdEntry* errors = d.find(0x1003, 0);
  errors->name = "Number of errors";
  errors->access = A::kReadWrite;
  errors->value = errors->initial = 0;
  d.variable(0x1005, "COB-ID SYNC message", T::kU32, A::kReadWrite, 0x80);
  d.text(0x1008, "Manufacturer device name", name);
  d.text(0x1009, "Manufacturer hardware version", "emulated");
  d.text(0x100A, "Manufacturer software version", "1.0");
  d.variable(0x1014, "COB-ID EMCY", T::kU32, A::kReadWrite, 0x80 + node).plus_node_id = true;
  d.structure(0x1016, "Consumer heartbeat time", OdShape::kArray);
  d.sub(0x1016, 1, "Consumer heartbeat time 1", T::kU32, A::kReadWrite, 0);
  d.sub(0x1016, 2, "Consumer heartbeat time 2", T::kU32, A::kReadWrite, 0);
  d.variable(0x1017, "Producer heartbeat time", T::kU16, A::kReadWrite, 0);
  d.structure(0x1018, "Identity object", OdShape::kRecord);
  d.sub(0x1018, 1, "Vendor-ID", T::kU32, A::kConst, 0);
  d.sub(0x1018, 2, "Product code", T::kU32, A::kConst, product);
  d.sub(0x1018, 3, "Revision number", T::kU32, A::kConst, 0x00010000);
  d.sub(0x1018, 4, "Serial number", T::kU32, A::kReadOnly, node).plus_node_id = true;
  d.structure(0x1029, "Error behaviour", OdShape::kArray);
  OdEntry& behaviour = d.sub(0x1029, 1, "Communication error", T::kU8, A::kReadWrite, 0);
  behaviour.low = 0;
  behaviour.high = 2;
  d.structure(0x1200, "SDO server parameter", OdShape::kRecord);
  d.sub(0x1200, 1, "COB-ID client to server (rx)", T::kU32, A::kReadOnly, 0x600 + node)
      .plus_node_id = true;
  d.sub(0x1200, 2, "COB-ID server to client (tx)", T::kU32, A::kReadOnly, 0x580 + node)
      .plus_node_id = true;
}

}  // namespace

CanopenNode::CanopenNode(int node_id, std::uint32_t device_type, const std::string& name,
                         std::uint32_t product_code)
    : id_(node_id),
      pdos_(dictionary_, node_id),
      sdo_(
          dictionary_,
          [this](std::uint16_t index, std::uint8_t sub, std::int64_t value) {
            return judgeAll(index, sub, value);
          },
          [this] { refresh(); }) {
  addCommonObjects(dictionary_, node_id, device_type, name, product_code);
}

void CanopenNode::powerOn() { bootUp(true); }

void CanopenNode::powerOff() {
  state_ = State::kOff;
  outbox_.clear();
  late_answers_.clear();
  onPowerOff();
}

// Leaves the initialisation state by itself: boot-up message, then pre-operational.
void CanopenNode::bootUp(bool application_too) {
  dictionary_.reset(0x1000, 0x1FFF);
  if (application_too) dictionary_.reset(0x2000, 0xFFFF);
  sdo_.reset();
  late_answers_.clear();
  consumers_ = {};
  receive_ = {};
  syncs_ = {};
  last_sent_ = {};
  if (application_too) onReset();
  CanFrame frame;
  frame.id = 0x700U + static_cast<unsigned>(id_);
  frame.size = 1;
  state_ = State::kPreOperational;
  outbox_.push_back(frame);
}

std::uint8_t CanopenNode::stateByte() const {
  switch (state_) {
    case State::kOperational:
      return 0x05;
    case State::kStopped:
      return 0x04;
    default:
      return 0x7F;
  }
}

void CanopenNode::enter(State state) {
  const bool was_operational = state_ == State::kOperational;
  if (state == state_) return;
  state_ = state;
  receive_ = {};
  syncs_ = {};
  last_sent_ = {};
  if (state == State::kStopped) {
    sdo_.reset();
    late_answers_.clear();
  }
  if (was_operational) onConnectionLost();
}

void CanopenNode::onNmt(std::uint8_t command) {
  switch (command) {
    case 0x01:
      return enter(State::kOperational);
    case 0x02:
      return enter(State::kStopped);
    case 0x80:
      return enter(State::kPreOperational);
    case 0x81:
      onPowerOff();
      return bootUp(true);
    case 0x82:
      if (state_ == State::kOperational) onConnectionLost();
      return bootUp(false);
    default:
      return;
  }
}

void CanopenNode::onFrame(const CanFrame& f) {
  if (state_ == State::kOff || f.extended) return;
  if (f.remote) return onRemoteRequest(f.id);
  const auto id = static_cast<unsigned>(id_);
  if (f.id == 0x000) {
    if (f.size == 2 && (f.data[1] == 0 || f.data[1] == id)) onNmt(f.data[0]);
    return;
  }
  if (f.id > 0x700 && f.id < 0x780) {
    if (f.size == 1) onHeartbeat(static_cast<int>(f.id - 0x700), f.data[0]);
    return;
  }
  if (state_ == State::kStopped) return;
  if (f.id == 0x600U + id) {
    if (f.size != 8 || mute_sdo_) return;
    CanFrame answer;
    answer.id = 0x580U + id;
    answer.size = 8;
    if (!sdo_.answer(f.data.data(), answer.data.data())) return;
    if (sdo_delay_ns_ == 0) {
      outbox_.push_back(answer);
    } else {
      late_answers_.push_back({now_ns_ + sdo_delay_ns_, answer});
    }
    onWritten();
    return;
  }
  if (f.id == (dictionary_.value(0x1005) & 0x7FF)) {
    if (f.size != 0) return emergency(kSyncLength, kCommunicationError);
    return;  // whoever owns the nodes calls onSync() for all of them together
  }
  if (state_ != State::kOperational) return;
  for (int i = 0; i < PdoRules::kPdoCount; ++i) {
    if (pdos_.valid(false, i) && pdos_.identifier(false, i) == f.id) return onReceivePdo(i, f);
  }
}

void CanopenNode::onRemoteRequest(std::uint32_t id) {
  if (state_ != State::kOperational) return;
  for (int i = 0; i < PdoRules::kPdoCount; ++i) {
    if (!pdos_.valid(true, i) || !pdos_.onRequest(i) || pdos_.identifier(true, i) != id) continue;
    refresh();
    sendPdo(i);
  }
}

void CanopenNode::onReceivePdo(int number, const CanFrame& frame) {
  const int wanted = pdos_.length(false, number);
  if (frame.size < wanted) return emergency(kPdoTooShort, kCommunicationError);
  if (frame.size > wanted) emergency(kPdoTooLong, kCommunicationError);  // the rest is ignored
  Receive& slot = receive_[static_cast<std::size_t>(number)];
  slot.watched = true;
  slot.last_ns = now_ns_;
  slot.frame = frame;
  if (pdos_.transmission(false, number) <= 240) {
    slot.latched = true;  // acts at the next SYNC
  } else {
    pdos_.unpack(number, frame);
    onWritten();
  }
}

void CanopenNode::sendPdo(int number) {
  CanFrame frame = pdos_.pack(number);
  const auto n = static_cast<std::size_t>(number);
  last_sent_[n] = frame;
  sent_ns_[n] = now_ns_;
  if (drop_pdos_) return;
  if (truncate_ && frame.size > 0) {
    frame.flexible = flexible_;
    do --frame.size;  // to the next length that there is
    while (!isValid(frame));
  }
  outbox_.push_back(frame);
}

void CanopenNode::onSync() {
  if (state_ != State::kOperational) return;
  refresh();
  for (int i = 0; i < PdoRules::kPdoCount; ++i) {
    if (!pdos_.valid(true, i)) continue;
    const int type = pdos_.transmission(true, i);
    if (type > 240) continue;
    const auto n = static_cast<std::size_t>(i);
    // Type 0: at a SYNC, but only after a change.
    const bool due =
        type == 0 ? !last_sent_[n] || *last_sent_[n] != pdos_.pack(i) : ++syncs_[n] >= type;
    if (!due) continue;
    syncs_[n] = 0;
    sendPdo(i);
  }
  bool written = false;
  for (int i = 0; i < PdoRules::kPdoCount; ++i) {
    Receive& slot = receive_[static_cast<std::size_t>(i)];
    if (!slot.latched) continue;
    slot.latched = false;
    pdos_.unpack(i, slot.frame);
    written = true;
  }
  if (written) onWritten();
}

void CanopenNode::onTime(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (state_ == State::kOff) return;
  while (!late_answers_.empty() && late_answers_.front().due_ns <= now_ns) {
    outbox_.push_back(late_answers_.front().frame);
    late_answers_.pop_front();
  }
  const std::int64_t period = dictionary_.value(0x1017) * kMs;
  if (period > 0 && now_ns >= next_heartbeat_ns_) {
    next_heartbeat_ns_ = now_ns + period;
    CanFrame frame;
    frame.id = 0x700U + static_cast<unsigned>(id_);
    frame.size = 1;
    frame.data[0] = stateByte();
    if (!heartbeat_stopped_) outbox_.push_back(frame);
  }
  checkConsumers();
  if (state_ != State::kOperational) return;
  bool fresh = false;
  for (int i = 0; i < PdoRules::kPdoCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (pdos_.valid(true, i) && pdos_.transmission(true, i) >= 254) {
      if (!fresh) refresh();
      fresh = true;
      const auto at = static_cast<std::uint16_t>(0x1800 + i);
      const std::int64_t inhibit = dictionary_.value(at, 3) * kInhibitUnit;
      const std::int64_t timer = dictionary_.value(at, 5) * kMs;
      const std::int64_t since = now_ns - sent_ns_[n];
      const bool changed = !last_sent_[n] || *last_sent_[n] != pdos_.pack(i);
      if ((changed && since >= inhibit) || (timer > 0 && since >= timer)) sendPdo(i);
    }
    Receive& slot = receive_[n];
    const std::int64_t deadline =
        dictionary_.value(static_cast<std::uint16_t>(0x1400 + i), 5) * kMs;
    if (slot.watched && deadline > 0 && now_ns - slot.last_ns > deadline) {
      slot.watched = false;
      connectionLost(kRpdoTimeout);
    }
  }
}

void CanopenNode::restartTimers() {
  next_heartbeat_ns_ = now_ns_;
  consumers_ = {};
  sent_ns_.fill(now_ns_);
  for (Receive& slot : receive_) slot.watched = false;
}

void CanopenNode::onHeartbeat(int producer, std::uint8_t state) {
  for (int i = 0; i < 2; ++i) {
    const std::int64_t entry = dictionary_.value(0x1016, static_cast<std::uint8_t>(i + 1));
    if ((entry >> 16 & 0x7F) != producer || (entry & 0xFFFF) == 0) continue;
    Consumer& c = consumers_[static_cast<std::size_t>(i)];
    if (c.lost) emergencyOver(kCommunicationError);
    c = {state != 0 || c.heard, false, now_ns_};
  }
}

void CanopenNode::checkConsumers() {
  for (int i = 0; i < 2; ++i) {
    const std::int64_t timeout =
        (dictionary_.value(0x1016, static_cast<std::uint8_t>(i + 1)) & 0xFFFF) * kMs;
    Consumer& c = consumers_[static_cast<std::size_t>(i)];
    if (timeout == 0 || !c.heard || c.lost || now_ns_ - c.last_ns <= timeout) continue;
    c.lost = true;
    connectionLost(kHeartbeatLost);
  }
}

// 1029:01 says what becomes of the node, 6007 (if it is a drive) what becomes of the torque.
void CanopenNode::connectionLost(std::uint16_t code) {
  emergency(code, kCommunicationError);
  onConnectionLost();
  const std::int64_t behaviour = dictionary_.value(0x1029, 1);
  if (behaviour == 0 && state_ == State::kOperational) enter(State::kPreOperational);
  if (behaviour == 2) enter(State::kStopped);
}

void CanopenNode::emergency(std::uint16_t code, std::uint8_t register_bit) {
  dictionary_.set(0x1001, dictionary_.value(0x1001) | kGenericError | register_bit);
  const std::int64_t count = std::min<std::int64_t>(dictionary_.value(0x1003) + 1, kErrorHistory);
  for (auto i = static_cast<std::uint8_t>(count); i > 1; --i) {
    dictionary_.set(0x1003, i, dictionary_.value(0x1003, static_cast<std::uint8_t>(i - 1)));
  }
  dictionary_.set(0x1003, 1, code);
  dictionary_.set(0x1003, 0, count);
  const std::int64_t cob = dictionary_.value(0x1014);
  if ((cob & kInvalid) != 0 || state_ == State::kStopped || state_ == State::kOff) return;
  CanFrame frame;
  frame.id = static_cast<std::uint32_t>(cob & 0x7FF);
  frame.size = 8;
  frame.data[0] = static_cast<std::uint8_t>(code & 0xFF);
  frame.data[1] = static_cast<std::uint8_t>(code >> 8);
  frame.data[2] = static_cast<std::uint8_t>(dictionary_.value(0x1001));
  outbox_.push_back(frame);
}

void CanopenNode::emergencyOver(std::uint8_t register_bit) {
  std::int64_t left = dictionary_.value(0x1001) & ~std::int64_t{register_bit};
  if (left == kGenericError) left = 0;
  const bool had_one = dictionary_.value(0x1001) != 0;
  dictionary_.set(0x1001, left);
  if (left != 0 || !had_one || state_ == State::kStopped || state_ == State::kOff) return;
  CanFrame frame;  // code 0000: error reset or no error
  frame.id = static_cast<std::uint32_t>(dictionary_.value(0x1014) & 0x7FF);
  frame.size = 8;
  if ((dictionary_.value(0x1014) & kInvalid) == 0) outbox_.push_back(frame);
}

std::uint32_t CanopenNode::judge(std::uint16_t, std::uint8_t, std::int64_t) { return kNone; }

std::uint32_t CanopenNode::judgeAll(std::uint16_t index, std::uint8_t sub, std::int64_t value) {
  if (index >= 0x2000) return judge(index, sub, value);
  if (index >= 0x1400 && index < 0x1C00) return pdos_.judge(index, sub, value);
  return judgeCommunication(index, sub, value);
}

std::uint32_t CanopenNode::judgeCommunication(std::uint16_t index, std::uint8_t sub,
                                              std::int64_t value) {
  switch (index) {
    case 0x1003:
      return value == 0 ? kNone : kValue;  // zero clears the history
    case 0x1005:
      // Consumer only: bit 30 would make it a producer. Bit 29 would be an extended identifier.
      return (value & 0x60000000) != 0 || (value & 0x7FF) == 0 ? kValue : kNone;
    case 0x1014: {
      const std::int64_t now = dictionary_.value(0x1014);
      const bool in_use = (now & kInvalid) == 0, stays = (value & kInvalid) == 0;
      if ((value & 0x60000000) != 0) return kValue;
      return in_use && stays && (now & 0x7FF) != (value & 0x7FF) ? kValue : kNone;
    }
    case 0x1016: {
      const std::int64_t other = dictionary_.value(0x1016, sub == 1 ? 2 : 1);
      const bool used = (value & 0xFFFF) != 0 && (value >> 16 & 0x7F) != 0;
      if ((value >> 16) > 0x7F) return kValue;
      if (used && (other & 0xFFFF) != 0 && (other >> 16) == (value >> 16)) return kIncompatible;
      consumers_[sub - 1U] = {};
      return kNone;
    }
    case 0x1017:
      next_heartbeat_ns_ = now_ns_;
      return kNone;
    default:
      return kNone;
  }
}

}  // namespace ballbot
