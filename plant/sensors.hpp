#pragma once

#include <cstdint>

#include "core/random.hpp"
#include "core/time.hpp"
#include "model/state.hpp"
#include "plant/multibody.hpp"

namespace ballbot {

class ConfigVisitor;

/// A sample is the average over the period before it. Standard deviations per axis.
struct ImuParameters {
  SimDuration period{2'500'000};
  double gyro_noise = 1.2e-4;         ///< white, density [rad/s/sqrt(Hz)]
  double accel_noise = 1.2e-3;        ///< white, density [m/s^2/sqrt(Hz)]
  double gyro_bias_walk = 2e-5;       ///< [rad/s/sqrt(s)]
  double accel_bias_walk = 3e-4;      ///< [m/s^2/sqrt(s)]
  double gyro_turn_on_bias = 0.003;   ///< [rad/s]
  double accel_turn_on_bias = 0.03;   ///< [m/s^2]
  double gyro_resolution = 1.065e-3;  ///< quantum of the output, 0 for none [rad/s]
  double accel_resolution = 4.79e-3;  ///< [m/s^2]

  void describe(ConfigVisitor& v);
};

struct EncoderParameters {
  double motor_resolution = 0;         ///< behind the gear, joint side [rad]
  double joint_resolution = 0;         ///< behind the spring [rad]
  double motor_velocity_filter = 400;  ///< low-pass on the differenced motor angle [Hz]
  double joint_velocity_filter = 80;   ///< low-pass on the differenced joint angle [Hz]

  void describe(ConfigVisitor& v);
};

struct SensorParameters {
  ImuParameters imu;
  EncoderParameters encoders;

  /// The `sensors:` of the `robot:` section.
  void describe(ConfigVisitor& v);
};

/// Nearest multiple of `quantum`; the value itself where the quantum is zero.
double quantized(double value, double quantum) noexcept;

/// Inertial measurement unit: adds to true averages what the device adds. Noise is drawn by sample
/// index, so a restored state repeats it.
class Imu {
 public:
  Imu(const ImuParameters& p, bool noisy, std::uint64_t seed);

  struct Sample {
    std::int64_t count = 0;  ///< samples so far
    SimTime time{};          ///< end of the averaging interval
    Vector3 accel_B = Vector3::Zero();
    Vector3 gyro_WB_B = Vector3::Zero();
  };

  /// Forgets all samples; biases are those of switching on.
  void reset();
  /// The sample that ends at `time`, from averages over its interval: specific force at the IMU
  /// [m/s^2] and angular velocity [rad/s], both in B.
  void sample(SimTime time, const Vector3& mean_specific_force, const Vector3& mean_rate);
  const Sample& last() const { return last_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.last_.count);
    visit(self.last_.time);
    visit(self.last_.accel_B);
    visit(self.last_.gyro_WB_B);
    visit(self.gyro_bias_);
    visit(self.accel_bias_);
  }

 private:
  ImuParameters p_;
  bool noisy_;
  RandomStream gyro_noise_, accel_noise_, gyro_walk_, accel_walk_, turn_on_;
  Vector3 gyro_bias_ = Vector3::Zero(), accel_bias_ = Vector3::Zero();
  Sample last_;
};

/// What the drives read of the joints.
struct JointReadings {
  JointVector motor_angle = JointVector::Zero();     ///< [rad]
  JointVector motor_velocity = JointVector::Zero();  ///< [rad/s]
  JointVector joint_angle = JointVector::Zero();     ///< [rad]
  JointVector joint_velocity = JointVector::Zero();  ///< [rad/s]
};

/// Two encoders per joint, read at every drive tick. Ideal encoders give exact angles and rates;
/// real ones whole counts, of which the drive makes rates by difference and low-pass.
class JointEncoders {
 public:
  JointEncoders(const EncoderParameters& p, bool ideal, SimDuration tick);

  bool ideal() const { return ideal_; }
  /// First reading: rates are zero.
  void reset(const JointMotion& motion);
  /// Reading at a drive tick.
  void tick(const JointMotion& motion);
  /// Readings at the last tick.
  const JointReadings& readings() const { return readings_; }

  /// Angles as the encoders show them right now.
  JointVector motorAngle(const JointMotion& motion) const;
  JointVector jointAngle(const JointMotion& motion) const;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.readings_.motor_angle);
    visit(self.readings_.motor_velocity);
    visit(self.readings_.joint_angle);
    visit(self.readings_.joint_velocity);
  }

 private:
  bool ideal_;
  double motor_resolution_, joint_resolution_;
  double tick_s_, motor_share_, joint_share_;  ///< low-pass: share of the new value per tick
  JointReadings readings_;
};

}  // namespace ballbot
