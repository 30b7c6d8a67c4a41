// A sensor: the temperature of each drive, as a first-order body that its torque warms.
#include <cmath>

#include "plant/added_sensors.hpp"
#include "tests/seams/additions.hpp"

namespace ballbot::test {
namespace {

struct Thermometer final : AddedSensorSettings {
  double ambient = 293, time_constant = 60;  ///< [K], [s]
  double rise_per_square = 0.5;  ///< in the end, per square of a torque that lasts [K/(N m)^2]

  void describe(ConfigVisitor& v) override {
    v.number(may("ambient_K", "temperature around the drives"), ambient, {200, 400});
    v.number(may("time_constant_s", "of a drive's warming"), time_constant, {1, 1e4});
    v.number(may("rise_K_per_Nm2", "in the end, per square of the torque"), rise_per_square,
             {0, 100});
  }
  std::vector<AddedSignal> signals() const override {
    std::vector<AddedSignal> out;
    for (const char* drive : {"wheel1", "wheel2", "wheel3", "arm1", "arm2", "arm3"}) {
      out.push_back({std::string("temperature_") + drive, "K", "of the drive's winding"});
    }
    return out;
  }
  std::unique_ptr<AddedSensor> make(std::uint64_t seed) const override;
};

class DriveTemperatures final : public AddedSensor {
 public:
  explicit DriveTemperatures(const Thermometer& p) : AddedSensor(kJointCount), p_(p) {}

  void reset(const TruthFrame&) override { state().assign(kJointCount, p_.ambient); }
  void advance(const TruthFrame& truth, SimDuration since) override {
    const double share = 1 - std::exp(-toSeconds(since) / p_.time_constant);
    for (int i = 0; i < kJointCount; ++i) {
      const double torque = truth.joint_torque[i];
      const double end = p_.ambient + p_.rise_per_square * torque * torque;
      double& temperature = state()[static_cast<std::size_t>(i)];
      temperature += share * (end - temperature);
    }
  }
  void read(double* values) const override { std::copy(state().begin(), state().end(), values); }

 private:
  Thermometer p_;
};

std::unique_ptr<AddedSensor> Thermometer::make(std::uint64_t) const {
  return std::make_unique<DriveTemperatures>(*this);
}

}  // namespace

void addDriveThermometer() {
  sensorKinds().add({"drive_thermometer", "temperature of each drive's winding",
                     [] { return std::make_shared<Thermometer>(); }});
}

}  // namespace ballbot::test
