#include "plant/plant.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "core/state_visitors.hpp"
#include "model/frames.hpp"
#include "model/signal_check.hpp"
#include "plant/added_truth.hpp"
#include "plant/drive_bank.hpp"
#include "plant/plant_dynamics.hpp"
#include "plant/plant_state_form.hpp"

namespace ballbot {
namespace {

constexpr const char* kBlobKind = "plant";
constexpr std::uint32_t kBlobVersion = 1;

std::unique_ptr<Integrator> makeIntegrator(const PlantConfig& c, int dim) {
  if (c.fidelity.contact != ContactLevel::kCompliant) return std::make_unique<RungeKutta4>(dim);
  return std::make_unique<ErrorControlledStep>(dim, c.integration_tolerance);
}

void requireFinite(const ActuatorCommand& command, SimTime t) {
  const std::string wrong = firstNonFinite(command);
  if (wrong.empty()) return;
  throw NumericalError(fmt::format("command at {}: {}, must be finite", toText(t), wrong));
}

}  // namespace

class Plant::Impl {
 public:
  explicit Impl(const PlantConfig& config)
      : config_(config),
        form_(plantStateForm(config)),
        ideal_actuators_(config.fidelity.actuators == ActuatorLevel::kIdeal),
        environment_(config.pushes),
        motion_capture_(config.motion_capture, config.seed),
        faults_(config.faults, config.sensors, config.seed),
        dynamics_(config),
        integrator_(makeIntegrator(config, dynamics_.dim())),
        state_(config, dynamics_.dim()),
        added_sensors_(config.added_sensors, config.seed),
        added_truth_(config) {
    reset(kSimStart);
  }

  void reset(SimTime start) {
    state_ = State(config_, dynamics_.dim());
    State& s = state_;
    s.start = s.now = s.last_tick = start;
    dynamics_.place(config_.initial.pose, s.y.data());
    dynamics_.actuators().reset();
    dynamics_.multibody().realize(s.y.data());
    s.drives.reset(dynamics_.multibody().joints());
    s.yaw = config_.initial.pose.yaw;
    const BaseMotion base = dynamics_.multibody().base();
    s.imu.sample(start, dynamics_.specificForce(base, BaseAcceleration{}), Vector3::Zero());
    motion_capture_.reset(start);
    motion_capture_.take({base.p_WK.x(), base.p_WK.y(), s.yaw});
    faults_.reset();
    meetFaults(dynamics_.multibody().joints());
    observe();
    added_sensors_.reset(truth_);
  }

  void advanceTo(SimTime end, const ActuatorCommand& command) {
    if (end <= state_.now) {
      throw InputError(fmt::format("plant: asked to advance from {} to {}, must be later",
                                   toText(state_.now), toText(end)));
    }
    requireFinite(command, state_.now);
    try {
      while (state_.now < end) substep(end, command);
    } catch (const Error&) {
      throw;
    } catch (const std::exception& e) {  // Simbody's, e.g. of a quaternion that is not finite
      throw NumericalError(fmt::format("plant at {}: {}", toText(state_.now), e.what()));
    }
    observe();
  }

  void setExternalForces(const ExternalForces& forces) {
    const bool finite = forces.base_force_W.allFinite() && forces.base_point_B.allFinite() &&
                        forces.end_effector_force_W.allFinite();
    if (!finite) {
      throw NumericalError(
          fmt::format("plant at {}: external forces must be finite", toText(now())));
    }
    external_ = forces;
  }

  StateBlob save() const {
    return sealState(kBlobKind, kBlobVersion, [&](StateSaver& visit) {
      visitState(state_, dynamics_.actuators(), faults_, motion_capture_, added_sensors_, visit);
    });
  }

  void restore(const StateBlob& blob) {
    State restored = state_;
    PlantDynamics::Actuators actuators = dynamics_.actuators();
    FaultInjector faults = faults_;
    MotionCapture capture = motion_capture_;
    AddedSensorBank::States added = added_sensors_.states();
    openState(blob, kBlobKind, kBlobVersion, [&](StateLoader& visit) {
      visitState(restored, actuators, faults, capture, added, visit);
    });
    faults_ = std::move(faults);
    motion_capture_ = std::move(capture);
    state_ = std::move(restored);
    dynamics_.actuators() = std::move(actuators);
    dynamics_.multibody().realize(state_.y.data());
    observe();
    added_sensors_.setStates(added);
  }

  std::uint64_t digest() const {
    hasher_.clear();
    visitState(state_, dynamics_.actuators(), faults_, motion_capture_, added_sensors_, hasher_);
    return hasher_.hash();
  }

  SimTime now() const { return state_.now; }
  const SensorFrame& sensors() const { return sensors_; }
  const TruthFrame& truth() const { return truth_; }
  const AddedSignals& added(AddedTo frame) const {
    switch (frame) {
      case AddedTo::kSensors:
        return added_sensors_.signals();
      case AddedTo::kTruth:
        return added_truth_.signals();
      default:
        return AddedSignals::none();
    }
  }

 private:
  /// Together with actuators, faults and motion capture all that must be saved to go on bit for
  /// bit.
  struct State {
    State(const PlantConfig& config, int dim)
        : y(dim, 0.0),
          drives(config),
          imu(config.sensors.imu, config.fidelity.noisy_sensors, config.seed) {}

    SimTime start{}, now{}, last_tick{};
    std::vector<double> y;
    double yaw = 0;          ///< continuous [rad]
    WheelContacts contacts;  ///< as the last step found them
    DriveBank drives;
    Imu imu;
  };

  template <typename AnyState, typename Actuators, typename Faults, typename Capture,
            typename Added, typename Visitor>
  void visitState(AnyState& s, Actuators& actuators, Faults& faults, Capture& capture, Added& added,
                  Visitor& visit) const {
    visit.form(form_, [this](const std::string& saved) {
      return fmt::format("saved plant state is of a plant with {}; this one has {}", saved, form_);
    });
    visit(s.start);
    visit(s.now);
    visit(s.last_tick);
    visit(s.y);
    visit(s.yaw);
    if (config_.knowsWheels()) visit(s.contacts);
    visit(actuators);
    visit(s.drives);
    visit(s.imu);
    visit(faults);
    visit(capture);
    visit(added);
  }

  bool isMultiple(SimTime t, SimDuration period) const {
    return (t - state_.start) % period == SimDuration::zero();
  }
  /// First whole multiple of `period` since the start after `t`.
  SimTime nextMultiple(SimTime t, SimDuration period) const {
    return state_.start + ((t - state_.start) / period + 1) * period;
  }

  SimTime nextEvent(SimTime end) const {
    const SimTime now = state_.now;
    SimTime next =
        std::min({end, nextMultiple(now, config_.drive_period),
                  nextMultiple(now, config_.sensors.imu.period), nextMultiple(now, config_.substep),
                  environment_.nextChange(now), faults_.nextChange(now)});
    if (motion_capture_.present()) {
      next = std::min(next, nextMultiple(now, motion_capture_.period()));
    }
    if (config_.initial.release > now) next = std::min(next, config_.initial.release);
    return next;
  }

  /// From one event to the next, or to `end`.
  void substep(SimTime end, const ActuatorCommand& command) {
    State& s = state_;
    if (isMultiple(s.now, config_.drive_period)) {
      JointVector motor_torque = s.drives.act(command);
      faults_.cut(s.now, motor_torque);
      dynamics_.demand(motor_torque, toSeconds(s.now - s.last_tick));
      s.last_tick = s.now;
    }
    const bool held = s.now < config_.initial.release;
    dynamics_.hold(held);
    dynamics_.forces().clear();
    environment_.addForces(s.now, dynamics_.forces());
    if (faults_.anySlip()) dynamics_.multibody().limitTraction(faults_.traction(s.now));
    addExternalForces(dynamics_.forces());

    const SimTime next = nextEvent(end);
    integrator_->step(dynamics_, toSeconds(s.now - s.last_tick), toSeconds(next - s.now),
                      s.y.data());
    s.contacts = held ? WheelContacts{} : dynamics_.multibody().wheelContacts();
    if (!held) dynamics_.project(s.y.data());
    for (const double value : s.y) {
      if (!std::isfinite(value)) {
        throw NumericalError(
            fmt::format("plant at {}: the state is not finite any more", toText(next)));
      }
    }
    s.now = next;
    arrive();
  }

  void addExternalForces(std::vector<PointForce>& forces) const {
    if (!external_.base_force_W.isZero(0)) {
      forces.push_back({kBaseBody, external_.base_point_B, external_.base_force_W});
    }
    if (!external_.end_effector_force_W.isZero(0)) {
      forces.push_back({kHandBody, config_.robot.p_A3E, external_.end_effector_force_W});
    }
  }

  /// What happens at a point of time: the IMU closes its interval, the drives read their encoders.
  void arrive() {
    State& s = state_;
    dynamics_.settle(s.y.data());
    const Multibody& robot = dynamics_.multibody();
    const double yaw = yawPitchRollFromRotation(robot.base().R_WB)[0];
    s.yaw += std::remainder(yaw - s.yaw, kTwoPi);
    if (isMultiple(s.now, config_.sensors.imu.period)) {
      const double period = toSeconds(config_.sensors.imu.period);
      auto force = PlantDynamics::forceIntegral(s.y.data(), dynamics_.dim());
      auto rate = PlantDynamics::rateIntegral(s.y.data(), dynamics_.dim());
      s.imu.sample(s.now, force / period, rate / period);
      force.setZero();
      rate.setZero();
    }
    if (isMultiple(s.now, config_.drive_period)) s.drives.sense(robot.joints());
    if (motion_capture_.present() && isMultiple(s.now, motion_capture_.period())) {
      const Vector3 p_WK = robot.base().p_WK;
      motion_capture_.take({p_WK.x(), p_WK.y(), s.yaw});
    }
    meetFaults(robot.joints());
    if (added_sensors_.any() && isMultiple(s.now, config_.drive_period)) {
      observe();
      added_sensors_.advance(truth_, config_.drive_period);
    }
  }

  void meetFaults(const JointMotion& joints) {
    if (!faults_.any()) return;
    faults_.arrive(state_.now, state_.drives.encoders().jointAngle(joints), state_.imu.last());
  }

  /// Fills the frames from the realized state.
  void observe() {
    const JointMotion joints = dynamics_.multibody().joints();
    const JointVector torque = dynamics_.jointTorque(toSeconds(state_.now - state_.last_tick));
    observeSensors(joints, torque);
    observeTruth(joints, torque);
  }

  void observeSensors(const JointMotion& joints, const JointVector& torque) {
    const JointEncoders& encoders = state_.drives.encoders();
    const Imu::Sample& imu = state_.imu.last();
    SensorFrame& f = sensors_;
    f.time = state_.now;
    f.motor_angle = encoders.motorAngle(joints);
    f.joint_angle = encoders.jointAngle(joints);
    f.joint_velocity = encoders.ideal() ? joints.velocity : encoders.readings().joint_velocity;
    f.joint_torque = torque;
    if (!ideal_actuators_ && !encoders.ideal()) {
      for (int i = 0; i < kJointCount; ++i) {
        f.joint_torque[i] =
            config_.actuators.of(i).spring_stiffness * (f.motor_angle[i] - f.joint_angle[i]);
      }
    }
    f.imu_count = imu.count;
    f.imu_time = imu.time;
    f.accel_B = imu.accel_B;
    f.gyro_WB_B = imu.gyro_WB_B;
    if (motion_capture_.present()) motion_capture_.report(state_.now, f);
    if (faults_.any()) faults_.apply(state_.now, f);
  }

  void observeTruth(const JointMotion& joints, const JointVector& torque) {
    const BaseMotion base = dynamics_.multibody().base();
    const BodyMotion hand = dynamics_.multibody().body(kHandBody);
    const Vector3 angles = yawPitchRollFromRotation(base.R_WB);
    TruthFrame& f = truth_;
    f.time = state_.now;
    f.state << base.p_WK.head<2>(), state_.yaw, angles[1], angles[2],
        joints.angle.tail<kArmJointCount>(), base.v_WK_W.head<2>(),
        base.R_WB.transpose() * base.w_WB_W, joints.velocity.tail<kArmJointCount>();
    f.joint_angle = joints.angle;
    f.joint_velocity = joints.velocity;
    f.motor_angle = joints.rotor_angle;
    f.joint_torque = torque;
    f.p_WE = hand.p_WL + hand.R_WL * config_.robot.p_A3E;
    const Eigen::Quaterniond q(Matrix3(hand.R_WL * config_.robot.R_A3E));
    f.quat_WE << q.w(), q.x(), q.y(), q.z();
    const Touch touch = dynamics_.touch(state_.y.data());
    const DoorMotion door = dynamics_.door(state_.y.data());
    f.contact_force_W = touch.force_W;
    f.contact_point_W = touch.foot_W;
    f.contact_phase = touch.phase;
    f.door_angle = door.angle;
    f.door_rate = door.rate;
    f.external_force_W = environment_.totalForce(state_.now) + external_.sum();
    if (!added_truth_.signals().empty()) {
      added_truth_.observe(dynamics_.ballOnFloor(), state_.contacts);
    }
  }

  PlantConfig config_;
  std::string form_;
  bool ideal_actuators_;
  Environment environment_;
  MotionCapture motion_capture_;
  FaultInjector faults_;
  ExternalForces external_;
  PlantDynamics dynamics_;
  std::unique_ptr<Integrator> integrator_;
  State state_;
  SensorFrame sensors_;
  TruthFrame truth_;
  AddedSensorBank added_sensors_;
  AddedTruth added_truth_;
  mutable StateHasher hasher_;
};

Plant::Plant(const PlantConfig& config) : impl_(std::make_unique<Impl>(config)) {}
Plant::~Plant() = default;
void Plant::reset(SimTime start) { impl_->reset(start); }
SimTime Plant::now() const { return impl_->now(); }
void Plant::advanceTo(SimTime t, const ActuatorCommand& command) { impl_->advanceTo(t, command); }
void Plant::setExternalForces(const ExternalForces& forces) { impl_->setExternalForces(forces); }
const SensorFrame& Plant::sensors() const { return impl_->sensors(); }
const TruthFrame& Plant::truth() const { return impl_->truth(); }
const AddedSignals& Plant::added(AddedTo frame) const { return impl_->added(frame); }
StateBlob Plant::saveState() const { return impl_->save(); }
void Plant::restoreState(const StateBlob& blob) { impl_->restore(blob); }
std::uint64_t Plant::stateDigest() const { return impl_->digest(); }

}  // namespace ballbot
