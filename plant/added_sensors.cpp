#include "plant/added_sensors.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

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
        sensors.push_back(settings);
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
  for (const auto& sensor : sensors) {
    for (AddedSignal& signal : sensor->signals()) out.list.push_back(std::move(signal));
  }
  out.values.assign(out.list.size(), 0.0);
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
  std::size_t first = 0;
  for (const auto& settings : list.sensors) {
    sensors_.push_back(settings->make(seed));
    first_value_.push_back(first);
    first += settings->signals().size();
  }
}

void AddedSensorBank::reset(const TruthFrame& truth) {
  for (const auto& sensor : sensors_) sensor->reset(truth);
  read();
}

void AddedSensorBank::advance(const TruthFrame& truth, SimDuration since) {
  for (const auto& sensor : sensors_) sensor->advance(truth, since);
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
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    sensors_[i]->read(signals_.values.data() + first_value_[i]);
  }
}

}  // namespace ballbot
