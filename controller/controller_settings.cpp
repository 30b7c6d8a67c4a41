#include "controller/controller_settings.hpp"

#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "controller/law_registry.hpp"
#include "core/error.hpp"
#include "core/foreign_code.hpp"

namespace ballbot {
namespace {

const LawKind& describeKind(ConfigVisitor& v) {
  return lawKinds().choose(
      v,
      must("kind",
           "which law balances the robot: the LQR, the whole-body MPC, or an MPC of the "
           "base with the arm controlled apart"),
      "mpc");
}

void describeKnownPayload(ConfigVisitor& v, double& payload) {
  v.number(may("known_payload_kg",
               "mass in the robot's hand that estimator and law count on; by "
               "default the one of the robot's own description"),
           payload, {0, 5});
}

/// What is believed of the world and of the robot itself, whatever the law.
void describeBeliefs(ConfigVisitor& v, ControllerSettings& settings) {
  const auto section = [&v](const char* key, const char* words, auto& belief) {
    v.section(may(key, words), [&belief](ConfigVisitor& in) { belief.describe(in); });
  };
  section("floor", "what is believed of the floor under the ball", settings.floor);
  section("wheel_loss", "when a wheel that slips, or whose drive is dead, is no longer counted on",
          settings.wheel_loss);
  section("push", "what is made of a force that acts now and that nothing explains", settings.push);
  section("offset_free", "lasting forces that the model does not know of", settings.offset_free);
}

/// What is learned has to have room to be learned in.
void requireRange(const ConfigReader& controller, const FloorBelief& floor) {
  if (!floor.limited || !floor.learned) return;
  const std::string section = controller.at("floor");
  if (floor.largest < floor.least) {
    throw InputError(fmt::format("{}: largest_Nm is {:g}, must be at least least_Nm ({:g})",
                                 section, floor.largest, floor.least));
  }
  if (floor.spin_torque < floor.least || floor.spin_torque > floor.largest) {
    throw InputError(fmt::format(
        "{}: spin_torque_Nm is {:g}, must be between least_Nm ({:g}) and largest_Nm ({:g}), within "
        "which it is learned; or set learned: false",
        section, floor.spin_torque, floor.least, floor.largest));
  }
}

/// Every section of every law, each once.
template <typename Use>
void forEachSection(Use&& use) {
  std::set<std::string> seen;
  for (const LawKind& kind : lawKinds().all()) {
    for (const LawSection& section : kind.sections) {
      if (seen.insert(section.key.name).second) use(section);
    }
  }
}

/// What cannot be balanced is a fault of the file in which it was asked for.
template <typename Work>
auto sayingWhere(const std::string& kind, const std::string& law, Work&& work) {
  try {
    return doneBy(fmt::format("{}: the law '{}'", kind, law), work);
  } catch (const NumericalError& e) {
    throw InputError(fmt::format(
        "{}: no such law balances this robot: {}. Masses and lengths (in m) are in robot.urdf, the "
        "pose is robot.nominal_arm_rad or that of the set point, weights are in lqr and mpc",
        kind, e.what()));
  }
}

}  // namespace

ControllerSettings ControllerSettings::read(ConfigReader& in, const RobotParameters& robot) {
  ControllerSettings out;
  ConfigReading reading(in);
  out.believed_robot = robot;
  describeKnownPayload(reading, out.believed_robot.payload_mass);
  const LawKind& kind = describeKind(reading);
  out.kind_ = in.at("kind");
  out.law_ = kind.name;
  out.law = sayingWhere(out.kind_, kind.name, [&] {
    auto read = kind.read(in, out.believed_robot);
    if (!read) throw std::logic_error("its LawKind::read() made nothing");
    return read;
  });
  ConfigReader tracker = in.child("tracker");
  out.tracker = TrackerConfig::read(tracker, robot);
  describeBeliefs(reading, out);
  requireRange(in, out.floor);
  tracker.finish();
  forEachSection([&](const LawSection& section) { in.raw(section.key.name); });
  in.finish();
  return out;
}

std::unique_ptr<ControlLaw> ControllerSettings::makeLaw() const {
  return sayingWhere(kind_, law_, [&] {
    auto made = law->makeLaw();
    if (!made) throw std::logic_error("its LawSettings::makeLaw() made nothing");
    return made;
  });
}

void describeController(ConfigVisitor& v, const RobotParameters& robot) {
  double known_payload = robot.payload_mass;
  TrackerConfig tracker = TrackerConfig::defaults(robot);
  describeKind(v);
  describeKnownPayload(v, known_payload);
  ControllerSettings at_first;
  describeBeliefs(v, at_first);
  v.section(must("tracker", "follows the law's plan, at the highest rate"),
            [&](ConfigVisitor& in) { tracker.describe(in); });
  forEachSection([&](const LawSection& section) {
    v.section(section.key, [&](ConfigVisitor& in) { section.describe(in, robot); });
  });
}

}  // namespace ballbot
