#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "hil/identify/record.hpp"

namespace ballbot {

/// The unknowns of the rotor's balance, all seen from the joint.
enum BalanceIndex : int {
  kRotorInertia,   ///< J [kg m^2]
  kStiffness,      ///< k [N m/rad]
  kSpringDamping,  ///< b [N m s/rad]
  kViscous,        ///< B [N m s/rad]
  kCoulomb,        ///< Fc [N m]
  kLoadFriction,   ///< m, of the torque that goes through the gear
  kBacklash,       ///< g, from flank to flank [rad]
  kBalanceCount,
};
using BalanceVector = Eigen::Matrix<double, kBalanceCount, 1>;
using BalanceMatrix = Eigen::Matrix<double, kBalanceCount, kBalanceCount>;

/// Spring torque and dry friction at one instant, and how they depend on what is unknown.
struct BalanceTerms {
  double spring = 0, dry_friction = 0;          ///< [N m]
  BalanceVector slope = BalanceVector::Zero();  ///< of spring + B v + dry friction
  double zero_slope = 0;                        ///< of the same, by the deflection's zero
};
/// @param sign        of the rotor's velocity, from -1 to 1
/// @param deflection  of the spring, backlash included, from the record's zero [rad]
/// @param rate        of the deflection [rad/s]
/// @param velocity    of the rotor [rad/s]
BalanceTerms balanceTerms(const BalanceVector& p, double sign, double deflection, double rate,
                          double velocity);

/// A record's equation of motion of the rotor,
///
///   tau_m = J theta'' + B theta' + (Fc + m |tau_s|) sgn theta' + tau_s,
///   tau_s = k dz(theta - q - zero) + b (theta' - q'),   dz: half of g left out on either side,
///
/// at samples around which the rotor turns in one direction faster than `least_speed`: below it
/// friction is no constant. Second differences of the angle are theta'' seen through a triangle of
/// two periods; all other terms are weighted so that they are seen through the same one up to the
/// fourth order of frequency times period (Numerov, 1924; the motor torque is a mean over a period
/// already), and all of them through one more low-pass against the encoders' noise.
class MomentumBalance {
 public:
  /// @param half_width  of the low-pass, in samples
  MomentumBalance(const Record& record, double least_speed, int half_width);

  const Record& record() const { return *record_; }
  int size() const { return static_cast<int>(centres_.size()); }
  /// Sample in the record of equation i.
  int sample(int i) const { return centres_[static_cast<std::size_t>(i)]; }
  /// Measured motor torque as equation i sees it [N m].
  double motorTorque(int i) const { return torque_[static_cast<std::size_t>(i)]; }

  /// Motor torque by the model in every equation [N m], and its slopes, a column each; the last row
  /// is that by the record's zero.
  struct Prediction {
    Eigen::VectorXd torque;
    Eigen::Matrix<double, kBalanceCount + 1, Eigen::Dynamic> slope;
  };
  Prediction predict(const BalanceVector& p, double zero) const;
  /// Measured minus predicted [N m].
  Eigen::VectorXd residuals(const Prediction& prediction) const;
  /// The mean deflection, to begin with [rad].
  double meanDeflection() const;
  /// Leaves out equations that see a deflection within half the backlash, and three standard
  /// deviations of the joint encoder's noise, of the zero: around a flank noise does not average
  /// out. Nothing is left out where too little would remain.
  void leaveOutFlanks(double zero, double backlash);
  /// What must be taken off the measured motor torque, one value a sample [N m].
  void correctTorque(const std::vector<double>& excess);

 private:
  void weighTorque();
  double deflectionNoise() const;

  const Record* record_;
  std::vector<double> velocity_, rate_, deflection_;  ///< one a sample
  std::vector<double> inner_weights_, torque_weights_;
  std::vector<int> centres_;
  std::vector<double> acceleration_, torque_;  ///< one an equation
  std::vector<double> excess_;                 ///< of the measured motor torque, one a sample
};

/// Rate of a signal by five samples, right up to the fourth order; zero at both ends.
std::vector<double> rateOf(const std::vector<double>& signal, double period);

}  // namespace ballbot
