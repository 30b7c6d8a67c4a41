#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "hil/can_frame.hpp"
#include "hil/emulator/object_dictionary.hpp"
#include "hil/emulator/pdo_rules.hpp"
#include "hil/emulator/sdo_server.hpp"

namespace ballbot {

/// An emulated CANopen node (CiA 301): network management, heartbeat in both directions, SDO
/// server, PDOs, emergency messages. What it does beyond that is added by drives and the IMU. It
/// has no clock: time comes with onTime().
class CanopenNode {
 public:
  CanopenNode(int node_id, std::uint32_t device_type, const std::string& name,
              std::uint32_t product_code);
  virtual ~CanopenNode() = default;
  CanopenNode(const CanopenNode&) = delete;
  CanopenNode& operator=(const CanopenNode&) = delete;

  int id() const { return id_; }
  ObjectDictionary& dictionary() { return dictionary_; }
  const ObjectDictionary& dictionary() const { return dictionary_; }

  /// All values as after switching on; boot-up message, then pre-operational.
  void powerOn();
  /// Silent and without torque until powerOn().
  void powerOff();
  bool powered() const { return state_ != State::kOff; }
  bool operational() const { return state_ == State::kOperational; }

  void onFrame(const CanFrame& frame);
  /// Samples inputs and sends synchronous PDOs, then takes over synchronous outputs.
  void onSync();
  /// @param now_ns never goes back
  void onTime(std::int64_t now_ns);
  /// On a CAN FD bus, where all it sends are such frames and a PDO may have 64 bytes.
  void setFlexible(bool on) {
    flexible_ = on;
    pdos_.setFlexible(on);
  }
  /// Its SDO server answers so long after the question; 0: at once.
  void setSdoDelay(std::int64_t delay_ns) { sdo_delay_ns_ = delay_ns; }
  bool owesAnswer() const { return !late_answers_.empty(); }
  /// Heartbeat and all watches begin anew, as if this were the moment of their set-up.
  void restartTimers();

  /// What it has to say, in order; the caller empties it.
  std::vector<CanFrame>& outbox() {
    for (CanFrame& frame : outbox_) frame.flexible = frame.fast = flexible_;
    return outbox_;
  }

  // Faults on demand.
  void stopHeartbeat(bool stopped) { heartbeat_stopped_ = stopped; }
  /// Sends PDOs of a length their mapping does not have.
  void truncatePdos(bool on) { truncate_ = on; }
  void dropPdos(bool on) { drop_pdos_ = on; }
  /// An SDO server that does not answer any more.
  void muteSdo(bool on) { mute_sdo_ = on; }
  /// As if somebody else had sent this NMT command.
  void forceNmt(std::uint8_t command) { onNmt(command); }

 protected:
  /// Application objects (2000 and above) that are about to be written; gives an abort code.
  virtual std::uint32_t judge(std::uint16_t index, std::uint8_t sub, std::int64_t value);
  /// Objects have been written, by SDO or PDO.
  virtual void onWritten() {}
  /// Input objects are about to be read or sent.
  virtual void refresh() {}
  /// Communication with the master broke: 1 fault, 2 disable voltage, 3 quick stop (6007).
  virtual void onConnectionLost() {}
  /// After power-on and resets, before the boot-up message.
  virtual void onReset() {}
  virtual void onPowerOff() {}

  PdoRules& pdos() { return pdos_; }
  void emergency(std::uint16_t code, std::uint8_t register_bit);
  /// One cause of an emergency is gone; when all are, code 0 is sent.
  void emergencyOver(std::uint8_t register_bit);
  std::int64_t now() const { return now_ns_; }

 private:
  enum class State : std::uint8_t { kOff, kPreOperational, kOperational, kStopped };

  std::uint32_t judgeAll(std::uint16_t index, std::uint8_t sub, std::int64_t value);
  std::uint32_t judgeCommunication(std::uint16_t index, std::uint8_t sub, std::int64_t value);
  void onNmt(std::uint8_t command);
  void enter(State state);
  void bootUp(bool application_too);
  void onRemoteRequest(std::uint32_t id);
  void onReceivePdo(int number, const CanFrame& frame);
  void onHeartbeat(int producer, std::uint8_t state);
  void checkConsumers();
  void sendPdo(int number);
  void connectionLost(std::uint16_t code);
  std::uint8_t stateByte() const;

  int id_;
  ObjectDictionary dictionary_;
  PdoRules pdos_;
  SdoServer sdo_;
  State state_ = State::kOff;
  std::vector<CanFrame> outbox_;
  struct LateAnswer {
    std::int64_t due_ns;
    CanFrame frame;
  };
  std::deque<LateAnswer> late_answers_;
  std::int64_t sdo_delay_ns_ = 0;
  std::int64_t now_ns_ = 0, next_heartbeat_ns_ = 0;
  struct Consumer {
    bool heard = false, lost = false;
    std::int64_t last_ns = 0;
  };
  std::array<Consumer, 2> consumers_{};
  struct Receive {
    bool latched = false, watched = false;
    CanFrame frame;
    std::int64_t last_ns = 0;
  };
  std::array<Receive, PdoRules::kPdoCount> receive_{};
  std::array<int, PdoRules::kPdoCount> syncs_{};
  std::array<std::optional<CanFrame>, PdoRules::kPdoCount> last_sent_{};
  std::array<std::int64_t, PdoRules::kPdoCount> sent_ns_{};
  bool flexible_ = false;
  bool heartbeat_stopped_ = false, truncate_ = false, drop_pdos_ = false, mute_sdo_ = false;
};

}  // namespace ballbot
