#pragma once

#include <type_traits>

#include "model/signals.hpp"

namespace ballbot {

/// What a drive applies of a command at joint angle q [rad] and rate dq [rad/s] [N m]: the law of
/// model/signals.hpp. For one joint (double), or for all (JointVector).
template <typename Values>
Values pdTorque(const Values& torque, const Values& stiffness, const Values& position,
                const Values& damping, const Values& velocity, const Values& q, const Values& dq) {
  if constexpr (std::is_same_v<Values, double>) {
    return torque + stiffness * (position - q) + damping * (velocity - dq);
  } else {
    return torque + stiffness.cwiseProduct(position - q) + damping.cwiseProduct(velocity - dq);
  }
}

inline JointVector pdTorque(const ActuatorCommand& c, const JointVector& q, const JointVector& dq) {
  return pdTorque<JointVector>(c.torque, c.stiffness, c.position, c.damping, c.velocity, q, dq);
}

}  // namespace ballbot
