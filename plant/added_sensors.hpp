#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "model/added_signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// A sensor beside those of the sensor frame, as it stands in a plant: from the true state at the
/// drives' ticks to values. docs/adding.md walks through one.
class AddedSensor {
 public:
  virtual ~AddedSensor() = default;

  /// At the start of a run, in the state it begins with.
  virtual void reset(const TruthFrame& truth) = 0;
  /// At every tick of the drives. @param since  the tick before
  virtual void advance(const TruthFrame& truth, SimDuration since) = 0;
  /// The values now, in the order of the settings' signals.
  virtual void read(double* values) const = 0;

  /// All that later values depend on; its size stays. What is saved, restored and hashed is this.
  std::vector<double>& state() { return state_; }
  const std::vector<double>& state() const { return state_; }

 protected:
  explicit AddedSensor(std::size_t state_size) : state_(state_size, 0.0) {}

 private:
  std::vector<double> state_;
};

/// Its settings: their keys, its signals, and what makes it.
class AddedSensorSettings {
 public:
  virtual ~AddedSensorSettings() = default;
  virtual void describe(ConfigVisitor& v) = 0;
  virtual std::vector<AddedSignal> signals() const = 0;
  /// @param seed  of the run, for noise from a RandomStream of its own name
  virtual std::unique_ptr<AddedSensor> make(std::uint64_t seed) const = 0;
};

/// A sensor as a scenario asks for it: `plant.added_sensors.NAME`.
struct SensorKind {
  std::string name;
  std::string words;
  /// With the defaults.
  std::function<std::shared_ptr<AddedSensorSettings>()> settings;
};

/// None but what others added (docs/adding.md).
Registry<SensorKind>& sensorKinds();

/// The sensors that a plant has beside those of the frame.
struct AddedSensorList {
  struct Entry {
    std::string name;  ///< of its kind
    std::shared_ptr<const AddedSensorSettings> settings;
  };
  std::vector<Entry> sensors;

  /// `added_sensors:` of the `plant:` section; not told where no kind was added.
  /// @throw InputError from a reader, also for more values than fit.
  void describe(ConfigVisitor& v);
  /// Of all of them, in order; the values are zero.
  AddedSignals signals() const;
  /// Their names; empty where there are none.
  std::string names() const;
};

/// The same of a scenario, without the rest of its plant. @throw InputError
AddedSensorList addedSensorsOf(const ConfigNode& scenario);

/// Those of a running plant. A sensor that throws, or whose value is not finite, is named.
/// @throw InputError (NumericalError of a value)
class AddedSensorBank {
 public:
  AddedSensorBank(const AddedSensorList& list, std::uint64_t seed);

  bool any() const { return !sensors_.empty(); }
  void reset(const TruthFrame& truth);
  void advance(const TruthFrame& truth, SimDuration since);
  /// With the values of now.
  const AddedSignals& signals() const { return signals_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    for (const auto& sensor : self.sensors_) visit(sensor->state());
  }
  /// The same as values, for who restores: the sensors themselves cannot be copied.
  using States = std::vector<std::vector<double>>;
  States states() const;
  void setStates(const States& states);

 private:
  /// @param use  is called with each sensor and its index
  template <typename Use>
  void forEach(Use&& use);
  void read();

  std::vector<std::unique_ptr<AddedSensor>> sensors_;
  std::vector<std::string> names_;        ///< for words
  std::vector<std::size_t> first_value_;  ///< and, at the end, how many there are
  AddedSignals signals_;
};

}  // namespace ballbot
