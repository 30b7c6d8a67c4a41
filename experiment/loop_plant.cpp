#include "experiment/loop_plant.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/angle.hpp"
#include "plant/torque_drive.hpp"

namespace ballbot {
namespace {

using Whole = Eigen::MatrixXd;

/// Exponential of M: the series of a part in which it converges fast, then squared.
Whole exponential(const Whole& M) {
  constexpr double kSmall = 0.1;
  constexpr int kTerms = 12;
  const double size = M.cwiseAbs().rowwise().sum().maxCoeff();
  const int doublings = std::max(0, static_cast<int>(std::ceil(std::log2(size / kSmall))));
  const Whole part = std::ldexp(1.0, -doublings) * M;
  Whole term = Whole::Identity(M.rows(), M.cols()), out = term;
  for (int n = 1; n <= kTerms; ++n) {
    term = (term * part / n).eval();
    out += term;
  }
  for (int i = 0; i < doublings; ++i) out = (out * out).eval();
  return out;
}

double lowPassShare(double bandwidth_Hz, double period) {
  return 1 - std::exp(-kTwoPi * bandwidth_Hz * period);
}

}  // namespace

LoopPlant::LoopPlant(const PlantConfig& config)
    : config_(config),
      elastic_(config.fidelity.actuators == ActuatorLevel::kSeriesElastic),
      ideal_encoders_(!config.fidelity.noisy_sensors || !config.fidelity.encoder_quantisation) {
  const ReducedDynamics dynamics(config.robot);
  const Equilibrium rest = findEquilibrium(dynamics, config.robot.nominal_arm);
  ReducedDynamics::Linearization model;
  dynamics.linearize(rest.x, rest.tau, Vector3::Zero(), model);
  rates_by_nu_ = dynamics.selectionMatrix(rest.x.head<kPositionDim>());
  const Eigen::Matrix<double, kPositionDim, kVelocityDim> dq_dnu =
      model.df_dx.topRightCorner<kPositionDim, kVelocityDim>();
  // Rolling is not integrable, but to first order about rest it is.
  angles_by_q_ = rates_by_nu_ * dq_dnu.inverse();
  angle_rates_ = dq_dnu.block<3, 3>(kYaw, kOmegaX);

  askDrives();
  rates_.setZero();
  rates_.topLeftCorner<kStateDim, kStateDim>() = model.df_dx;
  if (!elastic_) {
    rates_.block<kStateDim, kJointCount>(kX, kDemand) = model.df_dtau;
    return;
  }
  for (int j = 0; j < kJointCount; ++j) {  // docs/theory/actuator.md, eq. 1 and 2
    const ActuatorParameters& p = config.actuators.of(j);
    const double J = p.reflectedInertia();
    Eigen::Matrix<double, 1, kFlightDim + kJointCount> deflection_rate, spring;
    deflection_rate.setZero();
    deflection_rate[kRotorRate + j] = 1;
    deflection_rate.segment<kVelocityDim>(kX + kPositionDim) = -rates_by_nu_.row(j);
    spring = p.spring_damping * deflection_rate;
    spring[kDeflection + j] += p.spring_stiffness;
    rates_.topRows<kStateDim>() += model.df_dtau.col(j) * spring;
    rates_.row(kDeflection + j) = deflection_rate;
    rates_.row(kRotorRate + j) = -spring / J;
    rates_(kRotorRate + j, kMotor + j) = 1 / J;
    if (config.fidelity.friction) {
      rates_(kRotorRate + j, kRotorRate + j) -= p.viscous_friction / J;
    }
    const double lag_rate = kTwoPi * p.current_loop_bandwidth;
    rates_(kMotor + j, kMotor + j) = -lag_rate;
    rates_(kMotor + j, kDemand + j) = lag_rate;
  }
}

void LoopPlant::askDrives() {
  DriveOptions options;
  options.torque_loop = elastic_;
  options.saturation = false;
  options.leak_compensation = config_.leak_compensation;
  options.period = config_.drive_period;
  for (int j = 0; j < kJointCount; ++j) {
    for (int i = 0; i < DriveInput::RowsAtCompileTime; ++i) {
      const DriveInput in = DriveInput::Unit(i);
      TorqueDrive drive(config_.actuators.of(j), options);
      const auto load = [&](double& slow_velocity) { slow_velocity = in[5]; };
      TorqueDrive::visitState(drive, load);
      demand_(j, i) = drive.tick(in[0], {in[1], in[2], in[3], in[4]});
      const auto save = [&](double slow_velocity) { slow_velocity_(j, i) = slow_velocity; };
      TorqueDrive::visitState(drive, save);
    }
  }
  if (!config_.leak_compensation) slow_velocity_.setZero();  // kept, but of no consequence
}

LoopPlant::Flight LoopPlant::flightOver(SimDuration time) const {
  Whole M = Whole::Zero(kFlightDim + kJointCount, kFlightDim + kJointCount);
  M.topRows<kFlightDim>() = rates_;
  Flight flight = exponential(toSeconds(time) * M).topRows<kFlightDim>();
  if (!elastic_) flight.bottomRows<kFlightDim - kDeflection>().setZero();  // there are none
  return flight;
}

void LoopPlant::fly(const Flight& flight, StateRef z) {
  const Eigen::Matrix<double, kFlightDim, 1> next = flight * z.head<kFlightDim + kJointCount>();
  z.head<kFlightDim>() = next;
}

JointVector LoopPlant::jointAngle(const ConstStateRef& z) const {
  return angles_by_q_ * z.segment<kPositionDim>(kX);
}

JointVector LoopPlant::trueVelocity(const ConstStateRef& z) const {
  return rates_by_nu_ * z.segment<kVelocityDim>(kX + kPositionDim);
}

JointVector LoopPlant::jointVelocity(const ConstStateRef& z) const {
  return ideal_encoders_ ? trueVelocity(z) : JointVector(z.segment<kJointCount>(kJointVelocity));
}

void LoopPlant::sense(StateRef z) const {
  const EncoderParameters& p = config_.sensors.encoders;
  const double tick = toSeconds(config_.drive_period);
  const JointVector joint = jointAngle(z);
  const JointVector motor = joint + z.segment<kJointCount>(kDeflection);
  auto last_motor = z.segment<kJointCount>(kMotorAngle);
  auto last_joint = z.segment<kJointCount>(kJointAngle);
  auto motor_velocity = z.segment<kJointCount>(kMotorVelocity);
  auto joint_velocity = z.segment<kJointCount>(kJointVelocity);
  if (ideal_encoders_) {
    motor_velocity = elastic_ ? JointVector(z.segment<kJointCount>(kRotorRate)) : trueVelocity(z);
    joint_velocity = trueVelocity(z);
  } else {
    motor_velocity += lowPassShare(p.motor_velocity_filter, tick) *
                      ((motor - last_motor) / tick - motor_velocity);
    joint_velocity += lowPassShare(p.joint_velocity_filter, tick) *
                      ((joint - last_joint) / tick - joint_velocity);
  }
  last_motor = motor;
  last_joint = joint;
}

void LoopPlant::act(const JointVector& wanted, StateRef z) const {
  for (int j = 0; j < kJointCount; ++j) {
    DriveInput in;
    in << wanted[j], z[kMotorAngle + j], z[kMotorVelocity + j], z[kJointAngle + j],
        z[kJointVelocity + j], z[kSlowVelocity + j];
    z[kDemand + j] = demand_.row(j).dot(in);
    z[kSlowVelocity + j] = slow_velocity_.row(j).dot(in);
  }
}

}  // namespace ballbot
