#include "hil/identify/drive_loop.hpp"

#include <cmath>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr int kImages = 12;  // beyond them nothing of a command's steps is left

Complex sOf(double frequency_Hz) { return {0, kTwoPi * frequency_Hz}; }

/// (1 - e^(-sT)) / (sT): a hold, and a mean over a period at its end.
Complex holdOf(double frequency_Hz, double period) {
  const Complex x = sOf(frequency_Hz) * period;
  return std::abs(x) < 1e-9 ? Complex(1) : (1.0 - std::exp(-x)) / x;
}

}  // namespace

Complex DriveLoop::lag(double f) const { return 1.0 / (1.0 + sOf(f) * q_[kLag]); }

Complex DriveLoop::command(double f) const {
  return lag(f) * std::exp(q_[kLogGain] - sOf(f) * q_[kDelay]);
}

Complex DriveLoop::impedance(double f) const {
  const Complex s = sOf(f);
  const double Kp = std::exp(q_[kLogGain]) - 1;
  return p_[kRotorInertia] * s * s + (p_[kViscous] + p_[kSpringDamping]) * s + p_[kStiffness] +
         lag(f) * k0_ * (Kp + q_[kGainD] * s);
}

Complex DriveLoop::deflection(double f) const { return command(f) / impedance(f); }

Complex DriveLoop::motorTorque(double f) const {
  const Complex s = sOf(f);
  const double Kp = std::exp(q_[kLogGain]) - 1;
  return command(f) - lag(f) * k0_ * (Kp + q_[kGainD] * s) * deflection(f);
}

Complex DriveLoop::againstFriction(double f) const {
  const double Kp = std::exp(q_[kLogGain]) - 1;
  return lag(f) * k0_ * (Kp + q_[kGainD] * sOf(f)) / impedance(f);
}

double DriveLoop::bandwidth_Hz() const {
  const double level = std::sqrt(0.5);
  double low = 1e5;
  while (low > 1e-3 && std::abs(shown(low)) < level) low /= 1.05;
  double high = 1.05 * low;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::abs(shown(middle)) < level ? high : low) = middle;
  }
  return low;
}

Complex DriveLoop::sampledDeflection(double f, double period) const {
  Complex sum = 0;
  for (int k = -kImages; k <= kImages; ++k) {
    const double image = f + k / period;
    sum += holdOf(image, period) * deflection(image);
  }
  return sum;
}

Complex DriveLoop::torqueImages(double f, double period) const {
  Complex sum = 0;
  for (int k = -kImages; k <= kImages; ++k) {
    if (k == 0) continue;
    const double image = f + k / period;
    const Complex hold = holdOf(image, period);
    sum += hold * hold * motorTorque(image);
  }
  return sum;
}

Complex DriveLoop::sampledMotorTorque(double f, double period) const {
  const Complex hold = holdOf(f, period);
  return hold * hold * motorTorque(f) + torqueImages(f, period);
}

Complex DriveLoop::meanAgainstFriction(double f, double period) const {
  return holdOf(f, period) * againstFriction(f);
}

}  // namespace ballbot
