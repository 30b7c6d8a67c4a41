#include "plant/added_sensors.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/foreign_code.hpp"

namespace ballbot {

Registry<SensorKind>& sensorKinds() {
  static Registry<SensorKind> kinds({});
  return kinds;
}

void AddedSensorList::describe(ConfigVisitor& v) {
  if (sensorKinds().all().empty()) return;
  v.section(may("added_sensors", "sensors beside those of every robot"), [&](ConfigVisitor& in) {
    for (const SensorKind& kind : sensorKinds().all()) {
      in.section(may(kind.name.c_str(), kind.words.c_str()), [&](ConfigVisitor& section) {
        const std::shared_ptr<AddedSensorSettings> settings = kind.settings();
        settings->describe(section);
        sensors.push_back({kind.name, settings});
      });
    }
  });
  if (const std::size_t values = signals().list.size(); values > kMaxAddedSignals) {
    throw InputError(fmt::format("plant.added_sensors have {} values together, at most {} fit",
                                 values, kMaxAddedSignals));
  }
}

AddedSignals AddedSensorList::signals() const {
  AddedSignals out;
  for (const Entry& sensor : sensors) {
    for (AddedSignal& signal : sensor.settings->signals()) out.list.push_back(std::move(signal));
  }
  out.values.assign(out.list.size(), 0.0);
  return out;
}

std::string AddedSensorList::names() const {
  std::string out;
  for (const Entry& sensor : sensors) out += (out.empty() ? "" : ", ") + sensor.name;
  return out;
}

AddedSensorList addedSensorsOf(const ConfigNode& scenario) {
  AddedSensorList out;
  const ConfigNode* plant = scenario.find("plant");
  if (plant == nullptr) return out;
  ConfigReader in(*plant, "plant");
  ConfigReading reading(in);
  out.describe(reading);
  return out;
}

AddedSensorBank::AddedSensorBank(const AddedSensorList& list, std::uint64_t seed)
    : signals_(list.signals()) {
  first_value_.push_back(0);
  for (const AddedSensorList::Entry& entry : list.sensors) {
    names_.push_back("added sensor '" + entry.name + "'");
    sensors_.push_back(doneBy(names_.back(), [&] {
      auto made = entry.settings->make(seed);
      if (!made) throw std::logic_error("its AddedSensorSettings::make() made nothing");
      return made;
    }));
    first_value_.push_back(first_value_.back() + entry.settings->signals().size());
  }
}

template <typename Use>
void AddedSensorBank::forEach(Use&& use) {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    doneBy(names_[i], [&] { use(*sensors_[i], i); });
  }
}

void AddedSensorBank::reset(const TruthFrame& truth) {
  forEach([&](AddedSensor& sensor, std::size_t) { sensor.reset(truth); });
  read();
}

void AddedSensorBank::advance(const TruthFrame& truth, SimDuration since) {
  forEach([&](AddedSensor& sensor, std::size_t) { sensor.advance(truth, since); });
  read();
}

AddedSensorBank::States AddedSensorBank::states() const {
  States out;
  for (const auto& sensor : sensors_) out.push_back(sensor->state());
  return out;
}

void AddedSensorBank::setStates(const States& states) {
  for (std::size_t i = 0; i < sensors_.size(); ++i) sensors_[i]->state() = states[i];
  read();
}

void AddedSensorBank::read() {
  forEach([this](AddedSensor& sensor, std::size_t i) {
    sensor.read(signals_.values.data() + first_value_[i]);
    for (std::size_t k = first_value_[i]; k < first_value_[i + 1]; ++k) {
      if (std::isfinite(signals_.values[k])) continue;
      throw NumericalError(
          fmt::format("{}: {} is {}", names_[i], signals_.list[k].name, signals_.values[k]));
    }
  });
}

}  // namespace ballbot
