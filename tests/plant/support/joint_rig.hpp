#pragma once

#include <cmath>
#include <complex>
#include <functional>

#include "plant/integrator.hpp"
#include "plant/sensors.hpp"
#include "plant/series_elastic_actuator.hpp"
#include "plant/torque_drive.hpp"

namespace ballbot {

/// One actuator on a test bench: its output blocked (load inertia 0) or on a free inertia that may
/// have a damper and a spring to the ground.
class JointRig final : public OdeSystem {
 public:
  struct Options {
    double load_inertia = 0;    ///< [kg m^2]; 0: output blocked
    double load_damping = 0;    ///< [N m s/rad]
    double load_stiffness = 0;  ///< [N m/rad]
    bool friction = true, speed_limit = false, saturation = false, leak_compensation = false;
    bool ideal_encoders = true;
    EncoderParameters encoders;
    SimDuration period{400'000};
  };

  JointRig(const ActuatorParameters& p, const Options& options)
      : options_(options),
        actuator_(p, options.friction, options.speed_limit, true),
        drive_(p, {true, options.saturation, options.leak_compensation, options.period}),
        encoders_(options.encoders, options.ideal_encoders, options.period),
        tick_s_(toSeconds(options.period)),
        inertia_(p.reflectedInertia()) {
    encoders_.reset(motion());
  }

  /// One drive tick and the time up to the next.
  void tick(double wanted_torque) {
    encoders_.tick(motion());
    const JointReadings& r = encoders_.readings();
    actuator_.demand(drive_.tick(wanted_torque, {r.motor_angle[0], r.motor_velocity[0],
                                                 r.joint_angle[0], r.joint_velocity[0]}),
                     started_ ? tick_s_ : 0);
    started_ = true;
    rk4_.step(*this, 0, tick_s_, y_);
    time_ += tick_s_;
  }

  double time() const { return time_; }
  double motorVelocity() const { return y_[1]; }
  double springTorque() const { return actuator_.torques(tick_s_, actuatorMotion(y_)).joint; }
  double motorTorque() const { return actuator_.motorTorque(tick_s_); }

  void derivative(double since, const double* y, double* ydot) override {
    const auto t = actuator_.torques(since, actuatorMotion(y));
    ydot[0] = y[1];
    ydot[1] = t.rotor / inertia_;
    const bool blocked = options_.load_inertia == 0;
    ydot[2] = blocked ? 0 : y[3];
    ydot[3] = blocked ? 0
                      : (t.joint - options_.load_damping * y[3] - options_.load_stiffness * y[2]) /
                            options_.load_inertia;
  }

  /// Complex gain from wanted torque to spring torque at `frequency` [Hz], by correlation over
  /// whole periods after the start has died out.
  std::complex<double> response(double frequency, double amplitude) {
    const int per_period = static_cast<int>(std::round(1 / (frequency * tick_s_)));
    const double w = 2 * M_PI * usedFrequency(frequency);
    const int settle = static_cast<int>(std::ceil(1.0 / (per_period * tick_s_)));
    const int measure = static_cast<int>(std::ceil(0.4 / (per_period * tick_s_)));
    std::complex<double> sum = 0;
    for (int n = 0; n < (settle + measure) * per_period; ++n) {
      const double t = time_;
      if (n >= settle * per_period) {
        sum += springTorque() * std::exp(std::complex<double>(0, -w * t));
      }
      tick(amplitude * std::sin(w * t));
    }
    // sin = (e^jwt - e^-jwt) / 2j
    return 2.0 * sum / (measure * per_period * amplitude) * std::complex<double>(0, 1);
  }
  /// The frequency that response() really uses: one with whole ticks per period [Hz].
  double usedFrequency(double frequency) const {
    return 1 / (std::round(1 / (frequency * tick_s_)) * tick_s_);
  }

 private:
  static ActuatorMotion actuatorMotion(const double* y) { return {y[0], y[1], y[2], y[3]}; }
  JointMotion motion() const {
    JointMotion m;
    m.rotor_angle[0] = y_[0];
    m.rotor_velocity[0] = y_[1];
    m.angle[0] = y_[2];
    m.velocity[0] = y_[3];
    return m;
  }

  Options options_;
  SeriesElasticActuator actuator_;
  TorqueDrive drive_;
  JointEncoders encoders_;
  double tick_s_, inertia_;
  RungeKutta4 rk4_{4};
  double y_[4] = {0, 0, 0, 0};
  double time_ = 0;
  bool started_ = false;
};

}  // namespace ballbot
