#include <gtest/gtest.h>

#include "core/error.hpp"
#include "plant/plant.hpp"
#include "support/busy_command.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

/// Wheel torques alone, changing from call to call; true states on the way.
std::vector<StateVector> drivenByWheels(const std::vector<std::string>& overrides, double factor) {
  std::vector<std::string> all = overrides;
  all.push_back("initial={pitch_deg: 3}");
  Plant plant(plantConfig("full", all));
  std::vector<StateVector> states;
  for (int i = 1; i <= 50; ++i) {
    ActuatorCommand c;
    c.torque.head<kWheelCount>() = factor * Vector3(0.5, -0.8, 0.25) * std::sin(0.3 * i);
    plant.advanceTo(ms(0.4 * i), c);
    states.push_back(plant.truth().state);
  }
  return states;
}

TEST(WheelLoopInsertion, AGainIsAsGoodAsATorqueSoManyTimesLarger) {
  // A power of two multiplies without rounding.
  EXPECT_EQ(drivenByWheels({"plant.wheel_loop_insertion={gain: 4}"}, 1), drivenByWheels({}, 4));
  EXPECT_NE(drivenByWheels({"plant.wheel_loop_insertion={gain: 4}"}, 1), drivenByWheels({}, 1));
}

TEST(WheelLoopInsertion, ADelayIsAsGoodAsACommandThatComesLater) {
  EXPECT_EQ(drivenByWheels({"plant.wheel_loop_insertion={delay_ticks: 3}"}, 1),
            drivenByWheels({"plant.transport_delay_ticks=5"}, 1));  // 3 and the usual 2
}

TEST(WheelLoopInsertion, IsPartOfASavedState) {
  const std::vector<std::string> inserted = {"plant.wheel_loop_insertion={delay_ticks: 7}"};
  Plant plant(plantConfig("full", inserted)), other(plantConfig("full", inserted));
  plant.advanceTo(ms(10), busyCommand());
  other.restoreState(plant.saveState());
  plant.advanceTo(ms(20), ActuatorCommand{});
  other.advanceTo(ms(20), ActuatorCommand{});
  EXPECT_EQ(plant.stateDigest(), other.stateDigest());
  EXPECT_THROW(Plant(plantConfig("full")).restoreState(plant.saveState()), InputError);
}

}  // namespace
}  // namespace ballbot
