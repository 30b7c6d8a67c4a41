#include "plant/plant_state_form.hpp"

#include <fmt/format.h>

namespace ballbot {
namespace {

const char* nameOf(ContactLevel contact) {
  switch (contact) {
    case ContactLevel::kRolling:
      return "rolling";
    case ContactLevel::kRollingWithSpinFriction:
      return "rolling_with_spin_friction";
    case ContactLevel::kCompliant:
      break;
  }
  return "compliant";
}

}  // namespace

std::string plantStateForm(const PlantConfig& c) {
  const PlantFidelity& f = c.fidelity;
  return fmt::format(
      "multibody {}, actuators {}, contact {}, drive period {}, delay of {} ticks, IMU period "
      "{}{}{}{}{}{}",
      f.multibody == MultibodyStructure::kFull ? "full" : "reduced_wheels",
      f.actuators == ActuatorLevel::kIdeal ? "ideal" : "series_elastic", nameOf(f.contact),
      toText(c.drive_period), f.transport_delay ? c.transport_delay_ticks : 0,
      toText(c.sensors.imu.period), c.surroundings.door ? ", a door" : "",
      c.surroundings.wall ? ", a wall" : "",
      c.wheel_loop.delay_ticks > 0
          ? fmt::format(", a wheel loop delayed by {} ticks", c.wheel_loop.delay_ticks)
          : "",
      c.knowsWheels() ? ", contacts of wheels (fidelity.wheels, wheel_contact.recorded)" : "",
      c.added_sensors.sensors.empty() ? "" : ", added sensors " + c.added_sensors.names());
}

}  // namespace ballbot
