#include "plant/floor_contact.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

/// tanh(x) / x, smooth at zero.
double tanhShare(double x) { return x < 1e-4 ? 1 - x * x / 3 : std::tanh(x) / x; }

}  // namespace

void FloorContactParameters::describe(ConfigVisitor& v) {
  v.number(may("stiffness_N_per_m1_5", "of the floor: force per depth to the power of 3/2"),
           stiffness, {1e4, 1e12});
  v.number(may("dissipation_s_per_m",
               "of the floor: at an impact speed v the ball rebounds with about 1 - dissipation v"),
           dissipation, {0, 100});
  v.number(may("friction", "coefficient of friction between ball and floor"), friction, {0, 10});
  v.number(may("slip_velocity_m_per_s", "slip at which three quarters of the friction are reached"),
           slip_velocity, {1e-5, 1});
}

FloorLoad FloorContact::load(double height, const Vector3& v_WK_W, const Vector3& w_WK_W,
                             double spin_lever) const {
  const double depth = radius_ - height;
  if (depth <= 0) return {};
  const double normal = std::max(
      0.0, p_.stiffness * depth * std::sqrt(depth) * (1 - 1.5 * p_.dissipation * v_WK_W.z()));
  const Vector3 p_KC_W(0, 0, -height);  // the floor stays level, the ball gives way
  Vector3 slip = v_WK_W + w_WK_W.cross(p_KC_W);
  slip.z() = 0;
  FloorLoad out;
  out.force =
      -p_.friction * normal / p_.slip_velocity * tanhShare(slip.norm() / p_.slip_velocity) * slip;
  out.force.z() = normal;
  out.torque = p_KC_W.cross(out.force);
  out.torque.z() -= spin_lever * normal * std::tanh(w_WK_W.z() / spin_smoothing_);
  return out;
}

double FloorContact::restingDepth(double weight) const {
  return std::pow(weight / p_.stiffness, 2.0 / 3.0);
}

double FloorContact::energy(double height) const {
  const double depth = std::max(0.0, radius_ - height);
  return 0.4 * p_.stiffness * depth * depth * std::sqrt(depth);
}

}  // namespace ballbot
