#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "core/time.hpp"
#include "model/signals.hpp"
#include "plant/sensors.hpp"

namespace ballbot {

class ConfigNode;
class ConfigReader;
class ConfigVisitor;

/// Which further keys go with a fault depends on its kind; a reference has to tell all.
enum class FaultKeys { kOfItsKind, kOfEveryKind };

/// What goes wrong, and when: from `start` for `duration`. Faults of sensors are in what is
/// reported; the drives' own loops keep reading their encoders.
struct Fault {
  enum class Kind {
    kImuGap,        ///< no IMU sample arrives
    kEncoderStuck,  ///< a joint's angle stays as reported last, its rate is zero
    kSpikes,        ///< single values far off
    kWheelSlip,     ///< a wheel finds little traction on the ball
    kDriveDead,     ///< a motor gives no torque; its rotor turns with the joint
  };
  enum class Signal { kGyro, kAccel, kJoint };

  Kind kind = Kind::kImuGap;
  SimTime start{};
  SimDuration duration{};
  int joint = 0;                  ///< stuck or spoiled encoder, slipping wheel, dead drive
  Signal signal = Signal::kGyro;  ///< of spikes
  double size_sigma = 100;        ///< spikes in standard deviations of the sensor's own noise
  double share = 0.02;            ///< of the samples that are spoiled
  double traction_torque = 0.2;   ///< what a slipping wheel can still bring onto the ball [N m]

  void describe(ConfigVisitor& v, FaultKeys keys);

  SimTime end() const { return start + duration; }
  bool activeAt(SimTime t) const { return start <= t && t < end(); }
};

/// In the words of a configuration: "encoder_stuck wheel_2".
std::string toText(const Fault& fault);

/// `faults:` of the `plant:` section; those read are appended.
void describeFaults(ConfigVisitor& v, std::vector<Fault>& faults, FaultKeys keys);
/// Between the sensors and those they report to. What is spoiled depends on (seed, fault, sample)
/// alone; what is held is state.
class FaultInjector {
 public:
  /// @param sensors give the standard deviations
  FaultInjector(std::vector<Fault> faults, const SensorParameters& sensors, std::uint64_t seed);

  bool any() const { return !faults_.empty(); }
  bool anySlip() const;
  /// First time after `now` at which a fault sets in or ends; SimTime::max() if there is none.
  SimTime nextChange(SimTime now) const;
  /// What each wheel can bring onto the ball from `now` until the next change; infinite where
  /// nothing is wrong [N m].
  Vector3 traction(SimTime now) const;

  /// Takes from the motors' torques [N m] what dead ones do not give.
  void cut(SimTime now, JointVector& motor_torque) const;

  void reset();
  /// At every point of time at which a sensor may have a new value, in order.
  void arrive(SimTime now, const JointVector& joint_angle, const Imu::Sample& imu);
  /// Spoils a frame that says what the sensors say.
  void apply(SimTime now, SensorFrame& frame) const;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    if (self.faults_.empty()) return;
    visit(self.held_angle_);
    visit(self.held_since_);
    visit(self.delivered_.count);
    visit(self.delivered_.time);
    visit(self.delivered_.accel_B);
    visit(self.delivered_.gyro_WB_B);
  }

 private:
  bool stuck(SimTime now, int joint) const;
  bool gap(SimTime now) const;
  double jointSpike(const RandomStream& stream, const Fault& fault, SimTime now) const;
  Vector3 imuSpike(const RandomStream& stream, const Fault& fault, std::int64_t count) const;

  std::vector<Fault> faults_;
  std::vector<RandomStream> streams_;  ///< one per fault
  double gyro_sigma_, accel_sigma_;    ///< of one sample [rad/s], [m/s^2]
  double joint_sigma_;                 ///< of counting [rad]

  JointVector held_angle_ = JointVector::Zero();
  JointVector held_since_ =
      JointVector::Constant(-1);  ///< stuck since then; negative: it is not [s]
  Imu::Sample delivered_;         ///< the last one that arrived
};

}  // namespace ballbot
