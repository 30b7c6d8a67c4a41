#pragma once

#include <array>
#include <cstdint>

#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// What a controller knows about the robot, for the record.
struct EstimateFrame {
  SimTime time{};                           ///< it holds for
  StateVector state = StateVector::Zero();  ///< (q, nu) as in model/state.hpp
  /// One standard deviation of px, py [m], tilt about two axes, yaw [rad], vx, vy [m/s], w_WB_B
  /// [rad/s].
  Eigen::Matrix<double, 10, 1> sigma = Eigen::Matrix<double, 10, 1>::Zero();
  Vector3 contact_force_W = Vector3::Zero();  ///< environment on the end-effector [N]
  bool aligned = false;  ///< false until enough rest was seen to know tilt and gyro bias
};

/// What happened in one solve of a planner, for the record. How long it took is a fact of the
/// machine and is not in it.
struct PlanFrame {
  SimTime time{};                   ///< of the state the plan starts from
  SimTime acts_from{};              ///< when the plan comes into force
  bool accepted = false;            ///< false: the previous plan stays in force
  std::int32_t iterations = 0;      ///< of the solver in this call
  double cost = 0;                  ///< along the plan
  double step_length = 0;           ///< of the line search, 0 to 1
  double constraint_violation = 0;  ///< largest along the plan
  std::int8_t contact_state = 0;    ///< 0 no force asked for, 1 approach, 2 contact, 3 lost
  Vector3 contact_asked_W = Vector3::Zero();       ///< force on the end-effector asked for [N]
  Vector3 contact_counted_on_W = Vector3::Zero();  ///< the same as the plan takes it [N]
  std::int8_t status = 0;                          ///< PlanStatus of controller/control_law.hpp
  bool fallback = false;                ///< the balancing LQR stands in, for lack of a good plan
  double predicted_decrease = 0;        ///< of the cost, by the quadratic model
  double regularisation = 0;            ///< added to the diagonal of the input Hessian
  std::array<double, 20> cost_terms{};  ///< by task and barrier, as the controller names them
};

}  // namespace ballbot
