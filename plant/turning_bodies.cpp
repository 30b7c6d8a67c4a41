#include "plant/turning_bodies.hpp"

namespace ballbot {
namespace {

/// What is put in here is taken out of the carrier, so these two figures only have to be those of
/// some rigid body.
BodyInertia rotorInertia(double axial, const Vector3& axis) {
  BodyInertia rotor;
  rotor.mass = 0.05;
  rotor.I_LLcm_L = axial * (0.6 * Matrix3::Identity() + 0.4 * axis * axis.transpose());
  return rotor;
}

}  // namespace

BodyInertia withoutRotors(const BodyInertia& body, BodyIndex index, const RobotParameters& robot,
                          const MultibodyOptions& options) {
  BodyInertia rest = body;
  const auto mounts = actuatorMounts(robot);
  for (int i = 0; options.rotors && i < kJointCount; ++i) {
    if (mounts[i].parent != index) continue;
    rest = without(rest, rotorInertia(options.rotor_inertia[i], mounts[i].axis), mounts[i].p_PA_P);
  }
  return rest;
}

std::array<BodyInertia, kArmJointCount> linksWithoutRotors(const RobotParameters& robot,
                                                           const MultibodyOptions& options) {
  std::array<BodyInertia, kArmJointCount> links;
  for (int i = 0; i + 1 < kArmJointCount; ++i) {
    links[i] = withoutRotors(robot.arm[i].inertia, armBody(i), robot, options);
  }
  links.back() = robot.lastLinkWithPayload();
  return links;
}

SimTK::MobilizedBody addWheel(SimTK::MobilizedBody& base, const RobotParameters& robot, int wheel) {
  const Vector3 d = robot.wheelAxle(wheel);
  BodyInertia inertia;
  inertia.mass = robot.wheels.mass;
  inertia.I_LLcm_L = robot.wheels.transverse_inertia * (Matrix3::Identity() - d * d.transpose()) +
                     robot.wheels.spin_inertia * d * d.transpose();
  return SimTK::MobilizedBody::Pin(base, pinFrame(d, robot.wheelCentre(wheel)),
                                   toBody(inertia, "a wheel"), pinFrame(d, Vector3::Zero()));
}

SimTK::MobilizedBody addRotor(SimTK::MobilizedBody& carrier, const ActuatorMount& mount,
                              double axial_inertia) {
  return SimTK::MobilizedBody::Pin(carrier, pinFrame(mount.axis, mount.p_PA_P),
                                   toBody(rotorInertia(axial_inertia, mount.axis), "a rotor"),
                                   pinFrame(mount.axis, Vector3::Zero()));
}

}  // namespace ballbot
