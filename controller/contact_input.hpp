#pragma once

#include "controller/whole_body_cost.hpp"

namespace ballbot {

/// The end-effector's force and moment within an input (tau, force, moment) that may end after the
/// torques or after the force; what is missing is zero.
template <typename U>
ContactInput contactInput(const U& u) {
  constexpr int kGiven = U::RowsAtCompileTime - kJointCount;
  static_assert(kGiven == 0 || kGiven == 3 || kGiven == kContactDim);
  ContactInput out = ContactInput::Zero();
  if constexpr (kGiven > 0) out.template head<kGiven>() = u.template tail<kGiven>();
  return out;
}

/// What of it acts on the robot, in W: tasks decide.
struct ContactWrench {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();

  ContactWrench() = default;
  template <typename U>
  ContactWrench(const U& u, const Tasks& tasks) {
    const ContactInput given = contactInput(u);
    if (tasks.inContact()) force = tasks.R_WC * given.template head<3>();
    if (tasks.withMoments()) moment = tasks.R_WC * given.template tail<3>();
  }
};

/// Columns of the inputs' Jacobian that belong to force and moment, from those by a wrench in W.
template <int kGiven, typename Columns, typename ByForce, typename ByMoment>
void setContactColumns(const Tasks& tasks, const ByForce& by_force, const ByMoment& by_moment,
                       Columns&& out) {
  if constexpr (kGiven > 0) {
    out.setZero();
    if (tasks.inContact()) out.template leftCols<3>().noalias() = by_force * tasks.R_WC;
    if constexpr (kGiven > 3) {
      if (tasks.withMoments()) out.template rightCols<3>().noalias() = by_moment * tasks.R_WC;
    }
  }
}

/// The inputs' own expansion as R and r.
template <int NU, typename R, typename Gradient>
void setInputExpansion(const InputExpansion& input, R&& hessian, Gradient&& gradient) {
  hessian.setZero();
  hessian.diagonal() = input.diagonal.template head<NU>();
  gradient = input.gradient.template head<NU>();
  if constexpr (NU > kJointCount) {
    hessian.template block<3, 3>(kJointCount, kJointCount) = input.force_hessian;
  }
}

}  // namespace ballbot
