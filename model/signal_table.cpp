#include "model/signal_table.hpp"

#include <string>

namespace ballbot {
namespace {

/// "wheel1 wheel2 ...", as many as there are.
std::string numbered(const char* name, int count) {
  std::string out;
  for (int i = 1; i <= count; ++i) out += (i > 1 ? " " : "") + (name + std::to_string(i));
  return out;
}
const char* armNames() {
  static const std::string names = numbered("arm", kArmJointCount);
  return names.c_str();
}
const char* jointNames() {
  static const std::string names =
      numbered("wheel", kWheelCount) + (kArmJointCount > 0 ? " " : "") + armNames();
  return names.c_str();
}
constexpr const char* kAxes = "x y z";
constexpr const char* kPlane = "x y";
constexpr const char* kOne = "";

// A contiguous run of doubles from `member` on. Frames hold no padding between such, and a frame
// that is only read is never written through what reals() gives.
#define BALLBOT_REALS_OF(extent, frame, field, name, size, unit, elements, text, member) \
  Signal<frame> {                                                                        \
    field, name, extent, size, SignalKind::kReal, unit, elements, text,                  \
        largestOf(SignalKind::kReal, unit),                                              \
        [](const frame& f) -> const double* { return &(member); },                       \
        [](frame& f) -> double* { return &(member); }, nullptr, nullptr                  \
  }
#define BALLBOT_REALS(frame, field, name, size, unit, elements, text, member) \
  BALLBOT_REALS_OF(SignalExtent::kFixed, frame, field, name, size, unit, elements, text, member)
#define BALLBOT_JOINTS(frame, name, unit, text)                                                   \
  BALLBOT_REALS_OF(SignalExtent::kPerJoint, frame, #name, #name, kJointCount, unit, jointNames(), \
                   text, f.name[0])
#define BALLBOT_ARM(frame, field, name, unit, text, member)                              \
  BALLBOT_REALS_OF(SignalExtent::kPerArmJoint, frame, field, name, kArmJointCount, unit, \
                   armNames(), text, member)
#define BALLBOT_WHOLE(frame, kind, field, name, unit, largest, text, get, set)               \
  Signal<frame> {                                                                            \
    field, name, SignalExtent::kFixed, 1, kind, unit, kOne, text, largest, nullptr, nullptr, \
        [](const frame& f) -> std::int64_t { return get; },                                  \
        [](frame& f, std::int64_t value) { set; }                                            \
  }
#define BALLBOT_INTEGER(frame, kind, name, largest, text, member)                                \
  BALLBOT_WHOLE(frame, kind, name, name, "", largest, text, static_cast<std::int64_t>(f.member), \
                f.member = static_cast<decltype(f.member)>(value))
#define BALLBOT_COUNT(frame, name, text, member) \
  BALLBOT_INTEGER(frame, SignalKind::kCount, name, largestOf(SignalKind::kCount, ""), text, member)
#define BALLBOT_FLAG(frame, name, text, member)                                                    \
  BALLBOT_WHOLE(frame, SignalKind::kFlag, name, name, "", 1, text, std::int64_t{f.member ? 1 : 0}, \
                f.member = value != 0)
#define BALLBOT_TIME(frame, field, name, text, member)                               \
  BALLBOT_WHOLE(frame, SignalKind::kTime, field, name, "s", 0, text, toNs(f.member), \
                f.member = simTimeFromNs(value))

// The six quantities of a state (q, nu), with the word for whose it is.
#define BALLBOT_STATE(frame, whose)                                                        \
  BALLBOT_REALS(frame, "q", "ball_position_W", 2, "m", kPlane,                             \
                whose " position x, y of the ball centre in the world", f.state[kBallX]),  \
      BALLBOT_REALS(frame, "q", "base_angles", 3, "rad", "yaw pitch roll",                 \
                    whose " yaw (continuous), pitch, roll of the base", f.state[kYaw]),    \
      BALLBOT_ARM(frame, "q", "arm_angle", "rad", whose " angles of the arm joints",       \
                  f.state[kArm1]),                                                         \
      BALLBOT_REALS(frame, "nu", "ball_velocity_W", 2, "m/s", kPlane,                      \
                    whose " velocity x, y of the ball centre in the world",                \
                    f.state[kPositionDim + kBallVx]),                                      \
      BALLBOT_REALS(frame, "nu", "base_rate_B", 3, "rad/s", kAxes,                         \
                    whose " angular velocity of the base in the world, in the base frame", \
                    f.state[kPositionDim + kOmegaX]),                                      \
      BALLBOT_ARM(frame, "nu", "arm_rate", "rad/s", whose " rates of the arm joints",      \
                  f.state[kPositionDim + kArmRate1])

}  // namespace

const std::vector<Signal<ActuatorCommand>>& commandSignals() {
  static const std::vector<Signal<ActuatorCommand>> signals = {
      BALLBOT_JOINTS(ActuatorCommand, torque, "N m",
                     "feedforward torque at each joint: wheels, then arm joints"),
      BALLBOT_JOINTS(ActuatorCommand, position, "rad", "set-point of each joint's angle"),
      BALLBOT_JOINTS(ActuatorCommand, velocity, "rad/s", "set-point of each joint's rate"),
      BALLBOT_JOINTS(ActuatorCommand, stiffness, "N m/rad",
                     "gain on (position - joint angle) inside each drive"),
      BALLBOT_JOINTS(ActuatorCommand, damping, "N m s/rad",
                     "gain on (velocity - joint rate) inside each drive"),
  };
  return signals;
}

const std::vector<Signal<ExternalForces>>& externalForceSignals() {
  static const std::vector<Signal<ExternalForces>> signals = {
      BALLBOT_REALS(ExternalForces, "", "base_W", 3, "N", kAxes, "force on the base, in the world",
                    f.base_force_W[0]),
      BALLBOT_REALS(ExternalForces, "", "base_point_B", 3, "m", kAxes,
                    "where it acts, from the ball centre, in the base frame", f.base_point_B[0]),
      BALLBOT_REALS(ExternalForces, "", "end_effector_W", 3, "N", kAxes,
                    "force on the end-effector, in the world", f.end_effector_force_W[0]),
  };
  return signals;
}

const std::vector<Signal<SensorFrame>>& sensorSignals() {
  static const std::vector<Signal<SensorFrame>> signals = {
      BALLBOT_JOINTS(SensorFrame, motor_angle, "rad",
                     "encoders behind the gear, before the spring: wheels, then arm joints"),
      BALLBOT_JOINTS(SensorFrame, joint_angle, "rad",
                     "encoders behind the spring; wheels relative to the base"),
      BALLBOT_JOINTS(SensorFrame, joint_velocity, "rad/s",
                     "rate of joint_angle as the drive computes it"),
      BALLBOT_JOINTS(SensorFrame, joint_torque, "N m",
                     "spring torque on the joint, from the deflection"),
      BALLBOT_COUNT(SensorFrame, "imu_count",
                    "IMU samples so far; has grown when accel_B and gyro_WB_B are new", imu_count),
      BALLBOT_TIME(SensorFrame, "imu_time_ns", "imu_time",
                   "end of the interval the IMU sample is averaged over", imu_time),
      BALLBOT_REALS(SensorFrame, "accel_B", "accel_B", 3, "m/s^2", kAxes,
                    "specific force at the IMU, in the base frame", f.accel_B[0]),
      BALLBOT_REALS(SensorFrame, "gyro_WB_B", "gyro_WB_B", 3, "rad/s", kAxes,
                    "angular velocity of the base in the world, in the base frame", f.gyro_WB_B[0]),
      BALLBOT_COUNT(SensorFrame, "pose_count",
                    "external pose samples so far; 0 without such a measurement", pose_count),
      BALLBOT_TIME(SensorFrame, "pose_time_ns", "pose_time", "when the external pose was taken",
                   pose_time),
      BALLBOT_REALS(SensorFrame, "pose_W", "pose_position_W", 2, "m", kPlane,
                    "externally measured ball centre x, y in the world", f.pose_W[0]),
      BALLBOT_REALS(SensorFrame, "pose_W", "pose_yaw_W", 1, "rad", kOne,
                    "externally measured yaw, any whole turn", f.pose_W[2]),
  };
  return signals;
}

const std::vector<Signal<TruthFrame>>& truthSignals() {
  static const std::vector<Signal<TruthFrame>> signals = {
      BALLBOT_STATE(TruthFrame, "true"),
      BALLBOT_JOINTS(
          TruthFrame, joint_angle, "rad",
          "true joint angles: wheels, integrated, relative to the base, then arm joints"),
      BALLBOT_JOINTS(TruthFrame, joint_velocity, "rad/s", "true joint rates"),
      BALLBOT_JOINTS(TruthFrame, motor_angle, "rad",
                     "true rotor angles behind the gear, before the spring"),
      BALLBOT_JOINTS(TruthFrame, joint_torque, "N m",
                     "torque that the spring, or the ideal actuator, applies"),
      BALLBOT_REALS(TruthFrame, "p_WE", "p_WE", 3, "m", kAxes,
                    "true end-effector position in the world", f.p_WE[0]),
      BALLBOT_REALS(TruthFrame, "quat_WE", "quat_WE", 4, "", "w x y z",
                    "true end-effector orientation in the world: w, x, y, z", f.quat_WE[0]),
      BALLBOT_REALS(TruthFrame, "external_force_W", "external_force_W", 3, "N", kAxes,
                    "sum of pushes, in the world", f.external_force_W[0]),
      BALLBOT_REALS(TruthFrame, "contact_force_W", "contact_force_W", 3, "N", kAxes,
                    "surroundings on the end-effector, in the world", f.contact_force_W[0]),
      BALLBOT_REALS(TruthFrame, "contact_point_W", "contact_point_W", 3, "m", kAxes,
                    "where that force acts, in the world; without contact p_WE",
                    f.contact_point_W[0]),
      BALLBOT_INTEGER(TruthFrame, SignalKind::kCode, "contact_phase", 2,
                      "what the end-effector does: 0 touches nothing, 1 sticks, 2 slides",
                      contact_phase),
      BALLBOT_REALS(TruthFrame, "door_angle", "door_angle", 1, "rad", kOne,
                    "true angle of the door from closed; 0 without a door", f.door_angle),
      BALLBOT_REALS(TruthFrame, "door_rate", "door_rate", 1, "rad/s", kOne,
                    "true rate of the door's angle; 0 without a door", f.door_rate),
  };
  return signals;
}

const std::vector<Signal<EstimateFrame>>& estimateSignals() {
  static const std::vector<Signal<EstimateFrame>> signals = {
      BALLBOT_STATE(EstimateFrame, "estimated"),
      BALLBOT_REALS(EstimateFrame, "sigma", "sigma_ball_position_W", 2, "m", kPlane,
                    "one standard deviation of ball_position_W", f.sigma[0]),
      BALLBOT_REALS(EstimateFrame, "sigma", "sigma_tilt", 2, "rad", "1 2",
                    "one standard deviation of the tilt about two axes", f.sigma[2]),
      BALLBOT_REALS(EstimateFrame, "sigma", "sigma_yaw", 1, "rad", kOne,
                    "one standard deviation of the yaw", f.sigma[4]),
      BALLBOT_REALS(EstimateFrame, "sigma", "sigma_ball_velocity_W", 2, "m/s", kPlane,
                    "one standard deviation of ball_velocity_W", f.sigma[5]),
      BALLBOT_REALS(EstimateFrame, "sigma", "sigma_base_rate_B", 3, "rad/s", kAxes,
                    "one standard deviation of base_rate_B", f.sigma[7]),
      BALLBOT_REALS(EstimateFrame, "contact_force_W", "contact_force_W", 3, "N", kAxes,
                    "environment on the end-effector, from the arm's torques, in the world",
                    f.contact_force_W[0]),
      BALLBOT_FLAG(EstimateFrame, "aligned",
                   "0 until enough rest was seen to know tilt and gyro bias", aligned),
  };
  return signals;
}

const std::vector<Signal<PlanFrame>>& planSignals() {
  static const std::vector<Signal<PlanFrame>> signals = {
      BALLBOT_TIME(PlanFrame, "acts_from_ns", "acts_from", "when the plan comes into force",
                   acts_from),
      BALLBOT_FLAG(PlanFrame, "accepted", "0: the previous plan stays in force", accepted),
      BALLBOT_INTEGER(PlanFrame, SignalKind::kNumber, "iterations", 1e9,
                      "solver iterations of this call", iterations),
      BALLBOT_REALS(PlanFrame, "cost", "cost", 1, "", kOne, "value of the cost along the plan",
                    f.cost),
      BALLBOT_REALS(PlanFrame, "step_length", "step_length", 1, "", kOne,
                    "of the line search, 0 to 1", f.step_length),
      BALLBOT_REALS(PlanFrame, "constraint_violation", "constraint_violation", 1, "", kOne,
                    "largest violation of a constraint along the plan", f.constraint_violation),
      BALLBOT_INTEGER(PlanFrame, SignalKind::kCode, "contact_state", 3,
                      "0 no force asked for, 1 approach, 2 contact, 3 lost", contact_state),
      BALLBOT_REALS(PlanFrame, "contact_asked_W", "contact_asked_W", 3, "N", kAxes,
                    "force on the end-effector asked for, in the world", f.contact_asked_W[0]),
      BALLBOT_REALS(PlanFrame, "contact_counted_on_W", "contact_counted_on_W", 3, "N", kAxes,
                    "the same as the plan takes it: limited, dropped, added to",
                    f.contact_counted_on_W[0]),
      BALLBOT_INTEGER(PlanFrame, SignalKind::kCode, "status", 6,
                      "0 nothing to solve, 1 improved, 2 converged, 3 no descent, 4 not finite, 5 "
                      "not convex, 6 state not finite",
                      status),
      BALLBOT_FLAG(PlanFrame, "fallback", "the balancing LQR stands in, for lack of a good plan",
                   fallback),
      BALLBOT_REALS(PlanFrame, "predicted_decrease", "predicted_decrease", 1, "", kOne,
                    "of the cost, by the quadratic model", f.predicted_decrease),
      BALLBOT_REALS(PlanFrame, "regularisation", "regularisation", 1, "", kOne,
                    "added to the diagonal of the input Hessian", f.regularisation),
      BALLBOT_REALS(PlanFrame, "cost_terms", "cost_terms", 20, "", kOne,
                    "the cost by task and barrier, see controller/cost_terms.hpp", f.cost_terms[0]),
  };
  return signals;
}

#undef BALLBOT_STATE
#undef BALLBOT_REALS_OF
#undef BALLBOT_REALS
#undef BALLBOT_JOINTS
#undef BALLBOT_ARM
#undef BALLBOT_WHOLE
#undef BALLBOT_INTEGER
#undef BALLBOT_COUNT
#undef BALLBOT_FLAG
#undef BALLBOT_TIME

}  // namespace ballbot
