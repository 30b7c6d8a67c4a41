#include "hil/emulator/drive_node.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "hil/emulator/sdo_server.hpp"

namespace ballbot {
namespace {

using namespace sdo_abort;

constexpr std::uint32_t kServoDrive = 0x00020192;  // 1000: CiA 402, type 2: servo drive
constexpr double kNmPerMilli = 1e-3;
constexpr std::int64_t kModeCsp = 8, kModeCst = 10;
constexpr std::uint8_t kDeviceError = 0x80;
constexpr std::uint16_t kConnectionFault = 0x8130;

bool isSupported(std::int64_t mode) { return mode == 0 || mode == kModeCsp || mode == kModeCst; }

bool isOneOf(const std::vector<int>& values, std::int64_t value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

std::int64_t rounded(double value, double low, double high) {
  return std::llround(std::clamp(value, low, high));
}

}  // namespace

double EmulatedDriveParameters::torqueUnit() const {
  const std::int64_t mNm = torque_reference_mNm == 0 ? rated_torque_mNm : torque_reference_mNm;
  return static_cast<double>(mNm) * kNmPerMilli / 1000;
}
double EmulatedDriveParameters::velocityUnit() const {
  return velocity_unit == 0 ? kTwoPi / static_cast<double>(encoder_counts) : velocity_unit;
}

DriveNode::DriveNode(const EmulatedDriveParameters& p)
    : CanopenNode(p.node, kServoDrive, p.name, static_cast<std::uint32_t>(p.product_code)),
      parameters_(p) {
  addObjects(p);
  setSdoDelay(p.sdo_delay_ns);
}

std::uint32_t DriveNode::judge(std::uint16_t index, std::uint8_t, std::int64_t value) {
  switch (index) {
    case 0x6060:
      return isSupported(value) ? kNone : kValue;
    case 0x605A:
      return isOneOf(parameters_.quick_stop_options, value) ? kNone : kValue;
    case 0x605E:
      return isOneOf(parameters_.fault_reaction_options, value) ? kNone : kValue;
    case 0x6007:
      return isOneOf(parameters_.abort_connection_options, value) ? kNone : kValue;
    case 0x2020:  // where there is no stand nobody can set one
      return dictionary().value(0x2020, 1) == kNoStand || value == kNoStand ? kDeviceState : kNone;
    case 0x60C2:  // not while it is interpolating
      return enabled() ? kDeviceState : kNone;
    default:
      return kNone;
  }
}

void DriveNode::onReset() {
  power_ = Power::kSwitchOnDisabled;  // through "not ready to switch on", which takes no time here
  last_controlword_ = 0;
  forced_status_ = 0;
  held_torque_ = last_torque_ = 0;
}

void DriveNode::onPowerOff() {
  power_ = Power::kSwitchOnDisabled;
  last_torque_ = 0;
}

void DriveNode::onWritten() {
  const std::int64_t mode = dictionary().value(0x6060);
  if (dictionary().value(0x6061) != mode && isSupported(mode)) {  // a PDO is not judged
    // A change of mode starts from nothing: old targets mean something else.
    dictionary().set(0x6061, mode);
    dictionary().set(0x6071, 0);
  }
  OdEntry& stand = *dictionary().find(0x2020, 1);
  stand.initial = stand.value;  // no part of the node that a reset could reach
  obey(static_cast<std::uint16_t>(dictionary().value(0x6040)));
}

void DriveNode::setStand(StandOutput output) {
  OdEntry& stand = *dictionary().find(0x2020, 1);
  stand.value = stand.initial = static_cast<std::int64_t>(output);
}

StandOutput DriveNode::standOutput() const {
  return static_cast<StandOutput>(dictionary().value(0x2020, 1));
}

// CiA 402-2: commands are patterns of bits 0 to 3; fault reset is a rising edge of bit 7.
void DriveNode::obey(std::uint16_t c) {
  const bool reset_edge = (c & 0x80) != 0 && (last_controlword_ & 0x80) == 0;
  last_controlword_ = c;
  if (power_ == Power::kFault) {
    if (reset_edge && !cause_active_) {
      power_ = Power::kSwitchOnDisabled;
      dictionary().set(0x603F, 0);
      emergencyOver(kDeviceError);
    }
    return;
  }
  if (power_ == Power::kFaultReactionActive) return;
  const bool disable_voltage = (c & 0x02) == 0;
  const bool quick_stop = (c & 0x06) == 0x02;
  const bool shut_down = (c & 0x07) == 0x06;
  const bool switch_on = (c & 0x0F) == 0x07;
  const bool enable = (c & 0x0F) == 0x0F;
  switch (power_) {
    case Power::kSwitchOnDisabled:
      if (shut_down) power_ = Power::kReadyToSwitchOn;
      break;
    case Power::kReadyToSwitchOn:
      if (disable_voltage || quick_stop) power_ = Power::kSwitchOnDisabled;
      if (switch_on || enable) power_ = Power::kSwitchedOn;
      break;
    case Power::kSwitchedOn:
      if (disable_voltage || quick_stop) power_ = Power::kSwitchOnDisabled;
      if (shut_down) power_ = Power::kReadyToSwitchOn;
      if (enable && dictionary().value(0x6061) != 0) power_ = Power::kOperationEnabled;
      break;
    case Power::kOperationEnabled:
      if (disable_voltage) power_ = Power::kSwitchOnDisabled;
      if (quick_stop) startStop(Power::kQuickStopActive);
      if (shut_down) power_ = Power::kReadyToSwitchOn;
      if (switch_on) power_ = Power::kSwitchedOn;
      break;
    case Power::kQuickStopActive:
      if (disable_voltage) power_ = Power::kSwitchOnDisabled;
      if (enable && dictionary().value(0x605A) >= 5) power_ = Power::kOperationEnabled;
      break;
    default:
      break;
  }
}

void DriveNode::startStop(Power phase) {
  held_torque_ = last_torque_;
  stop_started_ns_ = now();
  power_ = phase;
  const std::int64_t option =
      dictionary().value(phase == Power::kQuickStopActive ? 0x605A : 0x605E);
  if (option == 0) finishStop();  // coasts at once
}

void DriveNode::finishStop() {
  held_torque_ = 0;
  if (power_ == Power::kFaultReactionActive) power_ = Power::kFault;
  if (power_ == Power::kQuickStopActive && dictionary().value(0x605A) < 5) {
    power_ = Power::kSwitchOnDisabled;
  }
}

bool DriveNode::energized() const {
  return powered() && (power_ == Power::kOperationEnabled || power_ == Power::kQuickStopActive ||
                       power_ == Power::kFaultReactionActive);
}

void DriveNode::raiseFault(std::uint16_t code, std::uint8_t register_bit) {
  if (!powered()) return;
  cause_active_ = true;
  dictionary().set(0x603F, code);
  emergency(code, static_cast<std::uint8_t>(register_bit | kDeviceError));
  if (power_ == Power::kFault || power_ == Power::kFaultReactionActive) return;
  if (energized()) {
    startStop(Power::kFaultReactionActive);
  } else {
    power_ = Power::kFault;
  }
}

void DriveNode::onConnectionLost() {
  switch (dictionary().value(0x6007)) {
    case 1:
      if (power_ == Power::kOperationEnabled || power_ == Power::kQuickStopActive) {
        dictionary().set(0x603F, kConnectionFault);
        startStop(Power::kFaultReactionActive);
      }
      break;
    case 2:
      if (energized()) power_ = Power::kSwitchOnDisabled;
      break;
    case 3:
      if (power_ == Power::kOperationEnabled) startStop(Power::kQuickStopActive);
      break;
    default:
      break;
  }
}

void DriveNode::sticking(bool on) {
  stuck_ = on;
  stuck_angle_ = feedback_.joint_angle;
}

// The target within the drive's own limit; a limited target shows in the statusword.
DriveOutput DriveNode::wanted() {
  const ObjectDictionary& d = dictionary();
  const double unit = parameters_.torqueUnit();
  const std::int64_t limit = d.value(0x6072);
  const bool position_mode = d.value(0x6061) == kModeCsp;
  const std::int64_t target = d.value(position_mode ? 0x60B2 : 0x6071);
  const std::int64_t given = std::clamp(target, -limit, limit);
  limited_ = given != target;
  dictionary().set(0x6074, given);
  DriveOutput out;
  out.torque = parameters_.sign * parameters_.torque_share * static_cast<double>(given) * unit;
  if (!position_mode) return out;
  const double turn = kTwoPi / static_cast<double>(parameters_.encoder_counts);
  out.position =
      parameters_.sign * static_cast<double>(d.value(0x607A)) * turn + parameters_.offset;
  out.velocity =
      parameters_.sign * static_cast<double>(d.value(0x60B1)) * parameters_.velocityUnit();
  out.stiffness = static_cast<double>(d.value(0x2010, 1)) * kNmPerMilli;
  out.damping = static_cast<double>(d.value(0x2010, 2)) * kNmPerMilli;
  return out;
}

DriveOutput DriveNode::output(std::int64_t now_ns) {
  DriveOutput out;
  if (power_ == Power::kQuickStopActive || power_ == Power::kFaultReactionActive) {
    const double slope =
        static_cast<double>(dictionary().value(0x6087)) * parameters_.torqueUnit();  // N m/s
    const double left =
        std::abs(held_torque_) - slope * 1e-9 * static_cast<double>(now_ns - stop_started_ns_);
    if (left <= 0) finishStop();
    out.torque = left > 0 ? std::copysign(left, held_torque_) : 0;
  } else if (power_ == Power::kOperationEnabled && powered()) {
    out = wanted();
  }
  if (!energized()) out = DriveOutput{};
  last_torque_ = out.torque;
  if (!energized()) dictionary().set(0x6074, 0);
  return out;
}

void DriveNode::refresh() {
  constexpr double kI32 = 2147483647, kI16 = 32767;
  ObjectDictionary& d = dictionary();
  const double s = parameters_.sign;
  const double joint = kTwoPi / static_cast<double>(parameters_.encoder_counts);
  const double motor = kTwoPi / static_cast<double>(parameters_.motor_encoder_counts);
  const double angle = stuck_ ? stuck_angle_ : feedback_.joint_angle;
  d.set(0x6064, rounded(s * (angle - parameters_.offset) / joint, -kI32, kI32));
  const double fastest = parameters_.velocity_bits == 16 ? kI16 : kI32;
  d.set(0x606C,
        rounded(s * feedback_.joint_velocity / parameters_.velocityUnit(), -fastest, fastest));
  if (parameters_.motor_encoder) {
    d.set(0x60E4, 1,
          rounded(s * (feedback_.motor_angle - parameters_.offset) / motor, -kI32, kI32));
  }
  const double felt = feedback_.joint_torque / parameters_.torque_share;
  d.set(0x6077, rounded(s * felt / parameters_.torqueUnit(), -kI16, kI16));
  const double motor_per_mille =
      static_cast<double>(parameters_.rated_current_torque_mNm) * kNmPerMilli / 1000;
  d.set(0x6078, rounded(s * feedback_.motor_torque / motor_per_mille, -kI16, kI16));
  if (enabled() && powered()) wanted();  // 6074 follows the target at once
  d.set(0x6041, forced_status_ != 0 ? forced_status_ : statusword());
}

std::uint16_t DriveNode::statusword() const {
  constexpr unsigned kVoltage = 1U << 4, kWarning = 1U << 7, kRemote = 1U << 9, kLimit = 1U << 11,
                     kFollows = 1U << 12;
  unsigned word = kVoltage | (operational() ? kRemote : 0U) | (warning_ ? kWarning : 0U);
  switch (power_) {
    case Power::kSwitchOnDisabled:
      word |= 0x40;
      break;
    case Power::kReadyToSwitchOn:
      word |= 0x21;
      break;
    case Power::kSwitchedOn:
      word |= 0x23;
      break;
    case Power::kOperationEnabled:
      word |= 0x27 | kFollows | (limited_ ? kLimit : 0U);
      break;
    case Power::kQuickStopActive:
      word |= 0x07;
      break;
    case Power::kFaultReactionActive:
      word |= 0x0F;
      break;
    case Power::kFault:
      word |= 0x08;
      break;
  }
  return static_cast<std::uint16_t>(word);
}

}  // namespace ballbot
